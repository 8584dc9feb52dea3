#include "AbaqusExport.h"

namespace surgicalmesher
{

void writeAbaqus(const FiniteElementModel&, const std::string& file, const Destination& destination)
{
  writeBytes("", destination(file));
}

} // namespace surgicalmesher
