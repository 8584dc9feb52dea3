// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Finite-element models into the files of solvers: one format per file extension, of which .simnibs.msh is one.

#include "FiniteElementModel.h"

#include <functional>

namespace surgicalmesher
{

/// Where to write a file now that will finally have another name: CommandLine::outputPath for outputs that appear whole
/// or not at all. A file that mentions a sidecar uses its final name.
using Destination = std::function<std::string(const std::string& finalPath)>;

struct ExportFormat
{
  std::string extension;   ///< lower case, with its dot
  std::string description; ///< for messages and help: "Abaqus, CalculiX"
  void (*write)(const FiniteElementModel& model, const std::string& file, const Destination& destination);
  bool hasSecondOrder = true; ///< knows tetrahedra of ten nodes
};

/// All formats, ascending by extension.
const std::vector<ExportFormat>& exportFormats();

/// Throws UsageError, with the known extensions, unless the extension of `file` (upper or lower case) is one of them.
const ExportFormat& exportFormatOf(const std::string& file);

/// Throws UsageError for an unknown extension, and if elements are of second order (`order` 2) and the format has none.
void requireOrder(const std::string& file, int order);

/// A file, or one for each tissue, that is written beside an exported one: `before`, the tissue's set name if there are
/// many, `after`.
struct ExportSidecar
{
  std::string before, after;
  bool isMany = false;
};

/// What exportModel writes besides `file`, if the mesh has curves or not.
std::vector<ExportSidecar> exportSidecars(const std::string& file, bool withCurves = false);

/// Writes the model, and beside it `<file>.names.json`, the map from set names to tissues (see setNamesJSON). Throws
/// UsageError for an unknown extension, or elements that the format does not know, InputError if a file can't be written to its end.
void exportModel(const FiniteElementModel& model, const std::string& file, const Destination& destination = {});

} // namespace surgicalmesher
