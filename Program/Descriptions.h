// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Descriptions (XML) of the commands, merged from their own options and those of the programs that they run.

#include "ModuleDescription.h"

#include <set>
#include <string>
#include <vector>

namespace surgicalmesher
{

// The texts of the .xml files; DescriptionTexts.cxx.in.
extern const char* const meshXML;
extern const char* const estimateXML;
extern const char* const qualityXML;
extern const char* const convertXML;
extern const char* const viewXML;
extern const char* const tissueMapperXML;
extern const char* const pathScaleXML;
extern const char* const simplexMesherXML;
extern const char* const tetrahedralizerXML;

/// Options of the programs that connect the stages, or are meant for other callers; users cannot give them.
const std::set<std::string>& stageOptions();

/// How outputs of the programs are treated when their options are merged.
enum class Outputs
{
  AsTexts, ///< their place does not depend on the command line alone
  LeftOut
};

/// Returns `command` with the options of `programs` appended under their mergedName(). An option of several programs
/// appears once, as described by the first of them; stageOptions() are left out.
std::string mergedDescription(const std::string& command, const std::vector<std::string>& programs,
                              Outputs outputs = Outputs::AsTexts);

/// Returns the name of a program's option among the merged ones: its own name, or, if an earlier program has an option
/// of this name with another default, its name prefixed by the program's. So each program keeps its defaults.
std::string mergedName(const std::string& name, const ModuleDescription& program);

/// Whether a merged option (with Outputs::AsTexts) is an output file of a program.
bool isOutputFile(const std::string& name);

} // namespace surgicalmesher
