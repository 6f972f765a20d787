#include "smoothing/methods/smoother.h"

namespace halfstep {

void Smoother::DeclareRequest(Fields& fields, MethodOptions options) const {
  std::string variables = "overlaps";
  fields.Text("variables", &variables, {});
  for (const DeclaredGroup& group : groups()) group.declare(fields, &options);
}

}  // namespace halfstep
