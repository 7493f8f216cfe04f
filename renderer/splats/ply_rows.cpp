#include "renderer/splats/ply_rows.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

namespace hipr {
namespace {

[[noreturn]] void endsEarly(const PlyElement& element) {
    throw SplatFileError("ends before its " + std::to_string(element.count) + " rows of '" + element.name +
                         "' do: it is cut off");
}

template <class T> T load(const unsigned char* from, bool swap) {
    unsigned char bytes[sizeof(T)];
    std::memcpy(bytes, from, sizeof(T));
    if (swap) std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

/// Calls visit(T()) with the C++ type of a PLY type.
template <class Visit> auto withType(PlyType type, Visit&& visit) {
    switch (type) {
    case PlyType::Int8:
        return visit(int8_t());
    case PlyType::Uint8:
        return visit(uint8_t());
    case PlyType::Int16:
        return visit(int16_t());
    case PlyType::Uint16:
        return visit(uint16_t());
    case PlyType::Int32:
        return visit(int32_t());
    case PlyType::Uint32:
        return visit(uint32_t());
    case PlyType::Float64:
        return visit(double());
    case PlyType::Float32:
        break;
    }
    return visit(float());
}

float toFloat(double value) {
    if (std::abs(value) <= double(std::numeric_limits<float>::max()) || std::isnan(value))
        return float(value);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return value > 0 ? infinity : -infinity;
}

bool swapped(PlyFormat format) {
    const uint16_t probe = 1;
    unsigned char first;
    std::memcpy(&first, &probe, 1);
    return (format == PlyFormat::BinaryBigEndian) == (first == 1);
}

/// Binary rows of one length: column by column, which spares a decision per number.
class FixedRows final : public PlyRows {
public:
    FixedRows(const PlyElement& element, PlyFormat format, const std::vector<int>& columns, PlyCursor& cursor)
        : _element(element), _columns(columns), _cursor(cursor), _rowBytes(element.rowBytes(format)),
          _swap(swapped(format)) {}

    void read(size_t rows, float* out) override {
        if (_rowBytes > 0 && rows > _cursor.left() / _rowBytes) endsEarly(_element);
        const unsigned char* first = _cursor.at;
        for (size_t p = 0; p < _columns.size(); ++p) {
            const PlyType type = _element.properties[p].type;
            if (_columns[p] != Skip) {
                withType(type, [&](auto zero) {
                    float* column = out + size_t(_columns[p]) * rows;
                    for (size_t row = 0; row < rows; ++row)
                        column[row] = toFloat(double(load<decltype(zero)>(first + row * _rowBytes, _swap)));
                });
            }
            first += plySize(type);
        }
        _cursor.at += rows * _rowBytes;
    }

private:
    const PlyElement& _element;
    const std::vector<int>& _columns;
    PlyCursor& _cursor;
    size_t _rowBytes;
    bool _swap;
};

/// Binary rows with lists, number by number.
class ListRows final : public PlyRows {
public:
    ListRows(const PlyElement& element, PlyFormat format, const std::vector<int>& columns, PlyCursor& cursor)
        : _element(element), _columns(columns), _cursor(cursor), _swap(swapped(format)) {}

    void read(size_t rows, float* out) override {
        for (size_t row = 0; row < rows; ++row)
            for (size_t p = 0; p < _columns.size(); ++p) {
                const PlyProperty& property = _element.properties[p];
                if (property.countType) {
                    skip(next(*property.countType), plySize(property.type));
                } else {
                    const float value = toFloat(next(property.type));
                    if (_columns[p] != Skip) out[size_t(_columns[p]) * rows + row] = value;
                }
            }
    }

private:
    double next(PlyType type) {
        const size_t bytes = plySize(type);
        if (_cursor.left() < bytes) endsEarly(_element);
        const double value =
            withType(type, [&](auto zero) { return double(load<decltype(zero)>(_cursor.at, _swap)); });
        _cursor.at += bytes;
        return value;
    }

    void skip(double items, size_t bytes) {
        if (!(items >= 0) || items != std::floor(items))
            throw SplatFileError("has a list of a length that cannot be");
        if (items > double(_cursor.left() / bytes)) endsEarly(_element);
        _cursor.at += size_t(items) * bytes;
    }

    const PlyElement& _element;
    const std::vector<int>& _columns;
    PlyCursor& _cursor;
    bool _swap;
};

/// Rows of text; where lines end does not matter.
class TextRows final : public PlyRows {
public:
    TextRows(const PlyElement& element, const std::vector<int>& columns, PlyCursor& cursor)
        : _element(element), _columns(columns), _cursor(cursor) {}

    void read(size_t rows, float* out) override {
        for (size_t row = 0; row < rows; ++row)
            for (size_t p = 0; p < _columns.size(); ++p) {
                const double value = next();
                if (_element.properties[p].countType) {
                    if (!(value >= 0) || value > double(_cursor.left())) endsEarly(_element);
                    for (size_t item = size_t(value); item > 0; --item)
                        next();
                } else if (_columns[p] != Skip) {
                    out[size_t(_columns[p]) * rows + row] = toFloat(value);
                }
            }
    }

private:
    double next() {
        const auto blank = [](unsigned char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
        while (_cursor.at < _cursor.end && blank(*_cursor.at))
            ++_cursor.at;
        if (_cursor.at == _cursor.end) endsEarly(_element);
        const char *begin = reinterpret_cast<const char*>(_cursor.at),
                   *end = reinterpret_cast<const char*>(_cursor.end);
        if (*begin == '+' && end - begin > 1) ++begin;
        double value = 0;
        const auto [last, error] = std::from_chars(begin, end, value);
        if (error == std::errc::invalid_argument ||
            (last != end && !blank(static_cast<unsigned char>(*last))))
            throw SplatFileError("holds something else where a number of '" + _element.name +
                                 "' should be: its PLY header announces text");
        _cursor.at = reinterpret_cast<const unsigned char*>(last);
        if (error == std::errc::result_out_of_range) {
            const bool tiny = std::find(begin + 1, last, '-') != last; // of the exponent
            return tiny ? 0.0 : std::numeric_limits<double>::infinity();
        }
        return value;
    }

    const PlyElement& _element;
    const std::vector<int>& _columns;
    PlyCursor& _cursor;
};

} // namespace

std::unique_ptr<PlyRows> plyRows(const PlyElement& element, PlyFormat format, const std::vector<int>& columns,
                                 PlyCursor& cursor) {
    if (format == PlyFormat::Ascii) return std::make_unique<TextRows>(element, columns, cursor);
    if (element.hasLists()) return std::make_unique<ListRows>(element, format, columns, cursor);
    return std::make_unique<FixedRows>(element, format, columns, cursor);
}

uint32_t plyWord(const unsigned char* at, PlyFormat format) {
    return load<uint32_t>(at, swapped(format));
}

void expectRoomFor(const PlyElement& element, PlyFormat format, const PlyCursor& cursor) {
    const size_t bytes = element.rowBytes(format);
    const size_t spare = format == PlyFormat::Ascii ? 1 : 0; // the last number may end the file
    if (bytes > 0 && element.count > (cursor.left() + spare) / bytes) endsEarly(element);
}

} // namespace hipr
