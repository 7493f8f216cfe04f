"""The one exception that reaches the user, and hints that turn a tool's output into what to do next."""

import re


class HiprError(Exception):
    """Something the user can act on: what went wrong, and in `hint` what to do about it."""

    def __init__(self, message: str, hint: str = ""):
        super().__init__(message)
        self.hint = hint


# Signs in a tool's output, in the order in which they explain a failure best.
_SIGNS = (
    (r"No space left on device|Disk quota exceeded",
     "The disk is full. Free some space (the build of OpenUSD needs 3 GB), then run the same command again: "
     "it continues where it stopped."),
    (r"Could not resolve host|Temporary failure (in name resolution|resolving)|Name or service not known"
     r"|Network is unreachable|Failed to establish a new connection|Could not connect|Connection refused"
     r"|Connection timed out|spurious network error|failed to download|Unable to connect",
     "The network did not answer. Check it (and proxy settings), then run the same command again: "
     "it continues where it stopped."),
    (r"Killed|ran out of memory|std::bad_alloc|Cannot allocate memory|virtual memory exhausted",
     "Memory ran out. Run the same command again with fewer parallel jobs, for example with --jobs 1."),
    (r"Could not get lock|is another process using it",
     "Another package installation is running. Wait until it is done, then run the same command again."),
    (r"Unable to locate package|has no installation candidate",
     "The package lists lack a package. Set-up knows Debian 12; elsewhere install OpenUSD 20.08 or later yourself "
     "and name it with --usd DIR."),
    (r"fatal error: '?[\w./+-]+'?(: No such file or directory| file not found)|Could NOT find \w+",
     "A development package seems to be missing. `hipr setup` lists and installs all of them."),
    (r"Permission denied",
     "A file or folder may not be written. HIPR_HOME names the folder where set-up works."),
)


def hint_for(output: str) -> str:
    """What to do about a tool that failed with this output; empty if it gives no known sign."""
    for pattern, hint in _SIGNS:
        if re.search(pattern, output):
            return hint
    return ""
