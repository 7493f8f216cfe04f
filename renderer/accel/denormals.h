/// @file denormals.h
/// Flushes denormals to zero on this thread while alive: as kernels do, and several times faster where they
/// occur.
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace hipr {

class FlushDenormals {
public:
#if defined(__SSE2__)
    FlushDenormals() : _saved(_mm_getcsr()) {
        _mm_setcsr(_saved | FLUSH_TO_ZERO | DENORMALS_ARE_ZERO);
    }
    ~FlushDenormals() {
        _mm_setcsr(_saved);
    }
#else
    FlushDenormals() {}
    ~FlushDenormals() {}
#endif
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

#if defined(__SSE2__)
private:
    static constexpr unsigned FLUSH_TO_ZERO = 0x8000, DENORMALS_ARE_ZERO = 0x0040;
    unsigned _saved;
#endif
};

} // namespace hipr
