/* Functions that cmake/Twins.cmake compiles once for each instruction set, with the same bits. */
#ifndef TL_TWINS_H
#define TL_TWINS_H

/* Declares all forms of `name`, of a function's type; TL_TWIN_OF is the one for this processor. */
#ifdef TL_HAS_FMA_TWINS
#    define TL_DECLARE_TWIN(type, name) extern type name##_portable, name##_fma
#    define TL_TWIN_OF(name) (__builtin_cpu_supports("fma") ? name##_fma : name##_portable)
#else
#    define TL_DECLARE_TWIN(type, name) extern type name##_portable
#    define TL_TWIN_OF(name) (name##_portable)
#endif

#endif
