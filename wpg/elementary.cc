#include "wpg/elementary.h"

extern "C" {
#include <sleef.h>
}

namespace halfstep {

// purec: plain C for one number; cinz: the same result on every CPU and compiler; u10: within 1.0
// unit in the last place.
SineCosine SinCos(double angle) {
  const Sleef_double_2 both = Sleef_cinz_sincosd1_u10purec(angle);
  return {both.x, both.y};
}
double Asin(double x) { return Sleef_cinz_asind1_u10purec(x); }
double Acos(double x) { return Sleef_cinz_acosd1_u10purec(x); }
double Atan2(double y, double x) { return Sleef_cinz_atan2d1_u10purec(y, x); }
double Exp(double x) { return Sleef_cinz_expd1_u10purec(x); }
double Log(double x) { return Sleef_cinz_logd1_u10purec(x); }
double Log10(double x) { return Sleef_cinz_log10d1_u10purec(x); }
double Pow(double x, double y) { return Sleef_cinz_powd1_u10purec(x, y); }

}  // namespace halfstep
