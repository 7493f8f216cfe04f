#include "renderer/shading/ies_profile.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

namespace hipr {

namespace {

constexpr double Pi = 3.14159265358979323846;
constexpr double MostAngles = 4096, FinestStep = 0.05, CoarsestStep = 0.5; // degrees
constexpr double Same = 1e-3;                                              // degrees
/// A file whose vertical angles span more is given for the whole sphere (as hdEmbree has it).
constexpr double HemisphereSpan = 95.7;

/// What the file says, before anything is made of it.
struct Measured {
    std::vector<double> vertical, horizontal; ///< degrees
    std::vector<double> candela;              ///< by horizontal, then vertical angle
};

/// Numbers separated by blanks, line ends or commas.
class Numbers {
public:
    explicit Numbers(const char* text) : _at(text) {}

    /// 0 with failed() when there is none.
    double next() {
        while (*_at == ',' || (*_at && std::isspace(static_cast<unsigned char>(*_at))))
            ++_at;
        char* end = nullptr;
        const double value = std::strtod(_at, &end);
        _failed |= end == _at || !std::isfinite(value);
        _at = end;
        return _failed ? 0.0 : value;
    }
    std::vector<double> next(size_t count) {
        std::vector<double> values;
        while (values.size() < count && !_failed)
            values.push_back(next());
        return values;
    }
    bool failed() const { return _failed; }

private:
    const char* _at;
    bool _failed = false;
};

/// Where the numbers begin: behind the line TILT=. npos without one.
size_t afterTilt(const std::string& text, bool& included) {
    const size_t tilt = text.find("TILT=");
    if (tilt == std::string::npos || (tilt > 0 && text[tilt - 1] != '\n' && text[tilt - 1] != '\r'))
        return std::string::npos;
    included = text.compare(tilt + 5, 7, "INCLUDE") == 0;
    return text.find_first_of("\r\n", tilt);
}

bool ascending(const std::vector<double>& values, double lowest, double highest) {
    return std::is_sorted(values.begin(), values.end(), [](double a, double b) { return a <= b; }) &&
           values.front() >= lowest - Same && values.back() <= highest + Same;
}

bool readMeasured(Numbers& numbers, Measured& out, std::string& error) {
    numbers.next(2); // lamps, lumens of each: both are in the candela values
    double factor = numbers.next();
    const double verticals = numbers.next(), horizontals = numbers.next(), type = numbers.next();
    numbers.next(4); // units and size of the luminous opening
    factor *= numbers.next();
    factor *= numbers.next(); // reserved, or ballast-lamp factor in old files
    numbers.next();           // watts
    const auto count = [](double n) { return n >= 1.0 && n <= MostAngles && n == std::floor(n); };
    if (numbers.failed() || !count(verticals) || !count(horizontals) || verticals < 2.0) {
        error = "is no IES profile that can be read";
        return false;
    }
    if (type != 1.0) {
        error = "is an IES profile of photometric type A or B; type C can be read";
        return false;
    }
    out.vertical = numbers.next(size_t(verticals));
    out.horizontal = numbers.next(size_t(horizontals));
    out.candela = numbers.next(size_t(verticals) * size_t(horizontals));
    const bool whole =
        !numbers.failed() && ascending(out.vertical, 0.0, 180.0) && ascending(out.horizontal, 0.0, 360.0);
    for (double& value : out.candela)
        value *= factor;
    const bool positive =
        std::all_of(out.candela.begin(), out.candela.end(), [](double v) { return v >= 0.0 && v < 1e30; });
    if (!whole || !positive) error = "is an IES profile that is broken off or has impossible numbers";
    return error.empty();
}

/// The interval of ascending `angles` that holds `angle`, and how far in.
size_t interval(const std::vector<double>& angles, double angle, double& share) {
    const size_t above = size_t(std::upper_bound(angles.begin(), angles.end(), angle) - angles.begin());
    const size_t i = std::min(std::max<size_t>(above, 1), angles.size() - 1) - 1;
    share = std::min(std::max((angle - angles[i]) / (angles[i + 1] - angles[i]), 0.0), 1.0);
    return i;
}

double alongVertical(const Measured& m, size_t column, double theta) {
    if (theta < m.vertical.front() - Same || theta > m.vertical.back() + Same) return 0.0;
    double share = 0.0;
    const size_t i = interval(m.vertical, theta, share);
    const double* values = &m.candela[column * m.vertical.size()];
    return values[i] * (1.0 - share) + values[i + 1] * share;
}

/// Horizontal angles by the symmetry that the last (and first) one tells: LM-63, "Horizontal angles".
double candelaAt(const Measured& m, double theta, double phi) {
    const double first = m.horizontal.front(), last = m.horizontal.back();
    if (m.horizontal.size() == 1) return alongVertical(m, 0, theta);
    if (std::abs(first - 90.0) < Same && std::abs(last - 270.0) < Same) {
        phi = phi < 90.0 ? 180.0 - phi : phi > 270.0 ? 540.0 - phi : phi;
    } else {
        const bool quadrant = std::abs(last - 90.0) < Same, half = std::abs(last - 180.0) < Same;
        if ((quadrant || half) && phi > 180.0) phi = 360.0 - phi;
        if (quadrant && phi > 90.0) phi = 180.0 - phi;
    }
    if (phi > last || phi < first) { // between the last and the first, a full turn later
        const double gap = first + 360.0 - last, share = ((phi > last ? phi : phi + 360.0) - last) / gap;
        return alongVertical(m, m.horizontal.size() - 1, theta) * (1.0 - share) +
               alongVertical(m, 0, theta) * share;
    }
    double share = 0.0;
    const size_t i = interval(m.horizontal, phi, share);
    return alongVertical(m, i, theta) * (1.0 - share) + alongVertical(m, i + 1, theta) * share;
}

double finestStep(const std::vector<double>& angles) {
    double step = CoarsestStep;
    for (size_t i = 1; i < angles.size(); ++i)
        step = std::min(step, angles[i] - angles[i - 1]);
    return std::max(step, FinestStep);
}

/// Mean over the sphere of a function that is linear between rows: the exact integral with the sine.
double sphereMean(const IesProfile& profile) {
    const double step = Pi / (profile.rows - 1);
    const auto rowMean = [&](uint32_t row) {
        const float* values = &profile.candela[size_t(row) * profile.columns];
        double sum = 0.0;
        for (uint32_t c = 0; c + 1 < profile.columns; ++c)
            sum += 0.5 * (double(values[c]) + double(values[c + 1]));
        return profile.columns > 1 ? sum / (profile.columns - 1) : double(values[0]);
    };
    double sum = 0.0, lower = rowMean(0);
    for (uint32_t row = 0; row + 1 < profile.rows; ++row) {
        const double a = row * step, b = a + step, upper = rowMean(row + 1), slope = (upper - lower) / step;
        sum += lower * std::cos(a) - upper * std::cos(b) + slope * (std::sin(b) - std::sin(a));
        lower = upper;
    }
    return 0.5 * sum;
}

} // namespace

bool parseIes(const std::vector<unsigned char>& bytes, IesProfile& profile, std::string& error) {
    const std::string text(bytes.begin(), bytes.end());
    bool tiltIncluded = false;
    const size_t begin = afterTilt(text, tiltIncluded);
    if (begin == std::string::npos) {
        error = "is no IES profile";
        return false;
    }
    Numbers numbers(text.c_str() + begin);
    if (tiltIncluded) { // how the lamp dims when it tilts: luminaires here do not say how far they do
        numbers.next();
        const double pairs = numbers.next();
        numbers.next(size_t(std::min(std::max(pairs, 0.0), MostAngles)) * 2);
    }
    Measured measured;
    if (!readMeasured(numbers, measured, error)) return false;
    profile.rows = uint32_t(std::lround(180.0 / finestStep(measured.vertical))) + 1;
    profile.columns = measured.horizontal.size() == 1 ? 1 : uint32_t(std::lround(360.0 / CoarsestStep)) + 1;
    profile.candela.clear();
    for (uint32_t row = 0; row < profile.rows; ++row)
        for (uint32_t column = 0; column < profile.columns; ++column)
            profile.candela.push_back(
                float(candelaAt(measured, 180.0 * row / (profile.rows - 1), CoarsestStep * column)));
    const bool sphere = measured.vertical.back() - measured.vertical.front() > HemisphereSpan;
    profile.mean = float(sphereMean(profile) * (sphere ? 1.0 : 2.0));
    return true;
}

} // namespace hipr
