#include "VtkExport.h"

namespace surgicalmesher
{

void writeVtk(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  writeMesh(model.content, destination(file));
}

} // namespace surgicalmesher
