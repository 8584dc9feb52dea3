// SPDX-License-Identifier: Apache-2.0
#include "Export.h"

#include "AbaqusExport.h"
#include "AnsysExport.h"
#include "Errors.h"
#include "FebioExport.h"
#include "GmshExport.h"
#include "LsDynaExport.h"
#include "MeditExport.h"
#include "NastranExport.h"
#include "TissueSurfaceExport.h"
#include "VtkExport.h"
#ifdef SURGICALMESHER_EXODUS
#include "ExodusExport.h"
#endif
#ifdef SURGICALMESHER_HDF5
#include "TextFile.h"
#include "XdmfExport.h"
#endif

#include <filesystem>

namespace surgicalmesher
{
namespace
{

/// Returns the format of `file` by its extension, one of two dots before one of one; null if it is unknown.
const ExportFormat* findFormat(const std::string& file)
{
  const std::string extension = text::extensionOf(file);
  const std::string ofTwo = text::extensionOf(std::filesystem::path(file).stem().string()) + extension;
  const ExportFormat* found = nullptr;
  for (const ExportFormat& format : exportFormats())
    if (format.extension == ofTwo || (!found && format.extension == extension)) found = &format;
  return found;
}

} // namespace

const std::vector<ExportFormat>& exportFormats()
{
  static const std::vector<ExportFormat> formats{
    { ".bdf", "Nastran", writeNastran },
    { ".cdb", "Ansys Mechanical APDL", writeAnsys },
#ifdef SURGICALMESHER_EXODUS
    { ".exo", "Exodus II", writeExodus },
#endif
    { ".feb", "FEBio 4.0", writeFebio },
    { ".inp", "Abaqus, CalculiX", writeAbaqus },
    { ".k", "LS-DYNA", writeLsDyna },
    { ".mesh", "Medit, FreeFEM", writeMedit, false },
    { ".msh", "Gmsh 4.1", writeGmsh41 },
    { ".msh2", "Gmsh 2.2, GetFEM", writeGmsh22 },
    { ".ply", "closed surfaces, one file per tissue", writeTissueSurfaces, false },
    { ".simnibs.msh", "SimNIBS", writeSimnibs, false },
    { ".stl", "closed surfaces, one file per tissue", writeTissueSurfaces, false },
    { ".vtk", "legacy VTK, SOFA", writeVtk },
    { ".vtu", "VTK", writeVtk },
#ifdef SURGICALMESHER_HDF5
    { ".xdmf", "XDMF, FEniCSx", writeXdmf },
#endif
  };
  return formats;
}

bool hasExportExtension(const std::string& file) { return findFormat(file) != nullptr; }

const ExportFormat& exportFormatOf(const std::string& file)
{
  if (const ExportFormat* found = findFormat(file)) return *found;
  std::string known;
  for (const ExportFormat& format : exportFormats()) known += (known.empty() ? "" : ", ") + format.extension;
  throw UsageError(file + ": extension \"" + text::extensionOf(file) + "\" found, one of " + known + " expected");
}

void requireOrder(const std::string& file, int order)
{
  const ExportFormat& format = exportFormatOf(file);
  if (order == 1 || format.hasSecondOrder) return;
  std::string known;
  for (const ExportFormat& other : exportFormats())
  {
    if (other.hasSecondOrder) known += (known.empty() ? "" : ", ") + other.extension;
  }
  throw UsageError(file + ": the format has no elements of second order, one of " + known + " expected");
}

std::vector<ExportSidecar> exportSidecars(const std::string& file, bool withCurves)
{
  const std::filesystem::path path(file);
  const std::string stem = (path.parent_path() / path.stem()).string(), extension = path.extension().string();
  const std::string& format = exportFormatOf(file).extension;
  std::vector<ExportSidecar> sidecars{ { file + ".names.json", "" } };
  if (format == ".stl" || format == ".ply") sidecars.push_back({ stem + ".", extension, true });
  if (format == ".xdmf")
  {
    sidecars.push_back({ stem + ".h5", "" });
    sidecars.push_back({ stem + "_facets" + extension, "" });
    sidecars.push_back({ stem + "_facets.h5", "" });
    if (withCurves)
    {
      sidecars.push_back({ stem + "_curves" + extension, "" });
      sidecars.push_back({ stem + "_curves.h5", "" });
    }
  }
  return sidecars;
}

void exportModel(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  const Destination place = destination ? destination : [](const std::string& finalPath) { return finalPath; };
  requireOrder(file, !model.elements.empty() && model.elements[0].size() == 10 ? 2 : 1);
  exportFormatOf(file).write(model, file, place);
  writeBytes(setNamesJSON(model), place(file + ".names.json"));
}

} // namespace surgicalmesher
