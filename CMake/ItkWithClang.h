// SPDX-License-Identifier: Apache-2.0
/// Read before all else by clang, for the sake of an ITK that was configured to know GCC alone, as Debian's is: in one
/// header, which only asks what of C++11 and C++14 the compiler has, clang is a GCC.
#pragma once
#ifdef __cplusplus
#if __has_include(<itk_compiler_detection.h>)
#pragma push_macro("__clang__")
#pragma push_macro("__GNUC__")
#undef __clang__
#undef __GNUC__
#define __GNUC__ 12
#include <itk_compiler_detection.h>
#pragma pop_macro("__GNUC__")
#pragma pop_macro("__clang__")
#endif
#endif
