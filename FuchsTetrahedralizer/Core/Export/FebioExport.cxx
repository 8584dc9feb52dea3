#include "FebioExport.h"

namespace surgicalmesher
{

void writeFebio(const FiniteElementModel&, const std::string& file, const Destination& destination)
{
  writeBytes("", destination(file));
}

} // namespace surgicalmesher
