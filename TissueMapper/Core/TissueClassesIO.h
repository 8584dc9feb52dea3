// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tissue classes and their training points, from files.

#include "TissueClassification.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// Every control point of `trainingFile` (.mrk.json, .fcsv) is a training point of the class that its label names;
/// classes are in the order of first appearance. `classesFile` (CSV; empty for none) has the columns `label`, `name`,
/// `compartment` (intracranial, extracranial, bone, any), `contiguity` (yes, no) and `limit` (mm), of which `name` is
/// needed; an empty field means the usual. Without it, labels are 1, 2, ... in the order of the classes. Throws
/// InputError for points without a label, fewer than two classes, and classes that are trained but not in the table, in
/// it twice or of a label that another has.
std::vector<TissueClass> readTissueClasses(const std::string& trainingFile, const std::string& classesFile);

/// A Slicer colour table of the classes: label, name, colour. Throws InputError if it can't be written whole.
void writeTissueNames(const TissueTable& table, const std::string& file);

} // namespace surgicalmesher
