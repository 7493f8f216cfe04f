/// @file wide_walk_headers.h
/// What wide_walk.inl includes.
#pragma once

#include <algorithm>
#include <cstring>

#include "renderer/accel/wide_walk.h"
#include "shaders/shared/segment.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif
