// Windows that a lane looks at together: a CPU works on 16 of them at once, each in its lane of a vector, so that sums
// over a window need not cross the vector; a lane of a GPU works on one.

#ifndef OUTDOOR_OMR_LANES_CL
#define OUTDOOR_OMR_LANES_CL

#include "geometry.cl"

#if LANES == 1
#define WINDOWS 16
typedef short16 Shorts;
typedef ushort16 UShorts;
typedef int16 Ints;
typedef float16 Floats;
#define AS_INTS as_int16
#define AS_FLOATS as_float16
#define AS_USHORTS as_ushort16
#define TO_INTS convert_int16
#define TO_SHORTS convert_short16
#define TO_FLOATS convert_float16
#define LOAD(from) vload16(0, from)
#define ANY(condition) any(condition)
#else
#define WINDOWS 1
typedef short Shorts;
typedef ushort UShorts;
typedef int Ints;
typedef float Floats;
#define AS_INTS as_int
#define AS_FLOATS as_float
#define AS_USHORTS as_ushort
#define TO_INTS convert_int
#define TO_SHORTS convert_short
#define TO_FLOATS convert_float
#define LOAD(from) (*(from))
#define ANY(condition) ((condition) != 0)
#endif

/** Values of the windows, one by one. */
typedef union
{
  Shorts all;
  short of[WINDOWS];
} ShortsOf;

typedef union
{
  Ints all;
  int of[WINDOWS];
} IntsOf;

typedef union
{
  Floats all;
  float of[WINDOWS];
} FloatsOf;

INLINE UShorts magnitude(Shorts value)
{
  const Shorts negative = -value;
  return AS_USHORTS(max(value, negative));
}

#endif
