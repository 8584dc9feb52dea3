// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Export of finite-element models to the file formats of solvers, one per file extension (.simnibs.msh counts as one
/// extension).

#include "FiniteElementModel.h"

#include <functional>

namespace surgicalmesher
{

/// Maps the final path of a file to the path to write it to now: CommandLine::outputPath for outputs that appear as a
/// whole or not at all. Files that refer to a sidecar use its final name.
using Destination = std::function<std::string(const std::string& finalPath)>;

struct ExportFormat
{
  std::string extension;   ///< lower case, with the dot
  std::string description; ///< for messages and help, e.g. "Abaqus, CalculiX"
  void (*write)(const FiniteElementModel& model, const std::string& file, const Destination& destination);
  bool hasSecondOrder = true; ///< supports ten-node tetrahedra
};

/// Returns all formats, ascending by extension.
const std::vector<ExportFormat>& exportFormats();

/// Whether the extension of `file` is that of a format, in upper or lower case.
bool hasExportExtension(const std::string& file);

/// Returns the format of `file` by its extension, in upper or lower case. Throws UsageError, with the known extensions,
/// if it is unknown.
const ExportFormat& exportFormatOf(const std::string& file);

/// Throws UsageError for an unknown extension, and if `order` is 2 but the format has no elements of second order.
void requireOrder(const std::string& file, int order);

/// A file, or one per tissue, written beside an exported one. Its path is `before` + `after`, with the set name of the
/// tissue in between if `isMany`.
struct ExportSidecar
{
  std::string before, after;
  bool isMany = false;
};

/// Returns the files that exportModel writes besides `file`, for a mesh with or without curves.
std::vector<ExportSidecar> exportSidecars(const std::string& file, bool withCurves = false);

/// Writes the model to `file`, and the map from set names to tissues (see setNamesJSON) to `<file>.names.json` beside
/// it. Throws UsageError for an unknown extension or elements that the format does not support, InputError if a file
/// cannot be written completely.
void exportModel(const FiniteElementModel& model, const std::string& file, const Destination& destination = {});

} // namespace surgicalmesher
