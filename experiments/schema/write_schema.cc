// The build step that writes the schema: halfstep_write_schema FILE.

#include <exception>
#include <iostream>

#include "experiments/schema/schema.h"
#include "wpg/files/whole_file.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    halfstep::WriteWhole(argv[1], {halfstep::SchemaText(halfstep::MakeSchema())});
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
