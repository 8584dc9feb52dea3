// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Reading of tissue classes and their training points, and writing of their names.

#include "TissueClassification.h"
#include "TissueMapIO.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// Groups training points into classes by their labels, ignoring case. Classes are in the order of first appearance and
/// get the labels 1, 2, ... Throws InputError for a point without a label; `source` names the origin of the points in
/// the message.
std::vector<TissueClass> trainedClasses(const std::vector<Markup>& training, const std::string& source);

/// Groups training points into classes and applies a table to them. `classesFile` (CSV; empty for none) has the columns
/// `label`, `name`, `compartment` (intracranial, intraorbital, extracranial, bone, any), `contiguity` (yes, no) and
/// `limit` (mm). `label` and `name` are required; an empty field of another column means its default. Throws InputError
/// for points without a label, for fewer than two classes, for a trained class that is missing from the table, listed
/// twice, or given the label of another class, and for contiguity or a limit of bone.
std::vector<TissueClass> tissueClasses(const std::vector<Markup>& training, const std::string& source,
                                       const std::string& classesFile);

/// The same, with the training points of a markups file (.mrk.json, .fcsv).
std::vector<TissueClass> readTissueClasses(const std::string& trainingFile, const std::string& classesFile);

/// Writes a Slicer colour table with label, name and colour of each class. Throws InputError if it cannot be written in
/// full.
void writeTissueNames(const TissueTable& table, const std::string& file);

} // namespace surgicalmesher
