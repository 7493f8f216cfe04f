"""What the log of a run is worth, given where the edit truly shows."""

import numpy as np

SHARES = (0.5, 0.9, 0.99)
DELTA = 1 / 255  # a change of less than this is not seen
BLOCK = 4  # pixels
CERTAIN = 2  # standard errors
LOCAL = 0.15  # of the frame


def difference(old, new):
    """D: how much a pixel changed, mean over the channels, rows bottom-up like the film's. A few samples a pixel are no
    converged reference: light that takes rare ways leaves specks all over the frame, which would count as changes. So the
    signed difference is averaged over BLOCK x BLOCK pixels first (as many samples as a reference of BLOCK^2 times the samples
    has), and counts where it stands out from its own noise, the standard error of that mean, and could be seen."""
    d = new.astype(np.float64) - old
    height, width, _ = d.shape
    padded = np.pad(d, ((0, -height % BLOCK), (0, -width % BLOCK), (0, 0)), mode="edge")
    blocks = padded.reshape(padded.shape[0] // BLOCK, BLOCK, -1, BLOCK, 3)
    means, errors = np.abs(blocks.mean(axis=(1, 3))), blocks.std(axis=(1, 3)) / BLOCK
    changes = np.where(means > CERTAIN * errors, means, 0).mean(axis=2)
    d = np.where(changes > DELTA, changes, 0)
    return d.repeat(BLOCK, axis=0).repeat(BLOCK, axis=1)[:height, :width][::-1]


def tile_energy(grid, d):
    rows = np.add.reduceat(d, np.arange(0, grid.height, grid.tile), axis=0)
    return np.add.reduceat(rows, np.arange(0, grid.width, grid.tile), axis=1).ravel()


def refreshed(run, energy, fine):
    """The share of the energy that lies in refreshed tiles, after each step: in tiles that show new samples, or might as well,
    which is where `fine(tile, samples)` says that the picture they keep is as good."""
    done, shares = np.zeros(run.grid.count, bool), []
    for step in run.steps:
        done[[tile for tile, _ in step.shows]] = True
        done[[tile for tile, samples in step.keeps if fine(tile, samples)]] = True
        shares.append(energy[done].sum() / energy.sum())
    return np.array(shares)


def times(run, shares):
    """For each of SHARES: paths and seconds until that share of the energy is refreshed."""
    result = []
    for share in SHARES:
        step = run.steps[int(np.argmax(shares >= share * (1 - 1e-12)))]
        result.append((step.paths, step.seconds))
    return result


def quality(run, energy):
    """Area under the energy captured by the run's order of tiles, over that of the best order; for the whole frame, and for
    as many tiles as the best order needs for 99 % of the energy."""
    order = run.order()
    ours, best = np.cumsum(energy[order]), np.cumsum(np.sort(energy)[::-1])
    needed = int(np.argmax(best >= 0.99 * best[-1])) + 1
    return ours.sum() / best.sum(), ours[:needed].sum() / best[:needed].sum()


def recall(tiles, energy):
    """The tiles' share of the energy."""
    return float(energy[list(tiles)].sum() / energy.sum()) if tiles else 0.0


def waste(tiles, energy):
    """The share of the tiles that hold nothing."""
    return float((energy[list(tiles)] == 0).mean()) if tiles else 0.0


def frame(run):
    """Paths and seconds of a one-sample frame: until every tile has a sample."""
    last = max(i for i, step in enumerate(run.steps) if step.sampled)
    return run.steps[last].paths, run.steps[last].seconds
