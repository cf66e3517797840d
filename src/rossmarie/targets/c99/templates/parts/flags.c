#if FLT_EVAL_METHOD != 0
#error "needs IEEE 754 binary64 without excess precision, as with -msse2 -mfpmath=sse"
#endif
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__)
#error "needs IEEE 754 semantics: compile without -ffast-math, and without any part of it"
#endif
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif
