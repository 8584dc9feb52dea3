// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tissue classes and their training points, from files.

#include "TissueClassification.h"
#include "TissueMapIO.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// Every training point is one of the class that its label names; classes are in the order of first appearance, their
/// labels 1, 2, ... Throws InputError for a point without a label; `source` says where the points come from.
std::vector<TissueClass> trainedClasses(const std::vector<Markup>& training, const std::string& source);

/// The same as a table says: `classesFile` (CSV; empty for none) has the columns `label`, `name`, `compartment`
/// (intracranial, intraorbital, extracranial, bone, any), `contiguity` (yes, no) and `limit` (mm), of which `name` is needed; an empty
/// field means the usual. Throws InputError for points without a label, fewer than two classes, and classes that are
/// trained but not in the table, in it twice or of a label that another has.
std::vector<TissueClass> tissueClasses(const std::vector<Markup>& training, const std::string& source,
                                       const std::string& classesFile);

/// The same of a markups file (.mrk.json, .fcsv).
std::vector<TissueClass> readTissueClasses(const std::string& trainingFile, const std::string& classesFile);

/// A Slicer colour table of the classes: label, name, colour. Throws InputError if it can't be written whole.
void writeTissueNames(const TissueTable& table, const std::string& file);

} // namespace surgicalmesher
