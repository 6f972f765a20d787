#include "opt/problem/function_block.h"

namespace halfstep::opt {

std::string FunctionBlock::RowName(int row) const {
  return name() + "[" + std::to_string(row) + "]";
}

}  // namespace halfstep::opt
