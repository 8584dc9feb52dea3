// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The descriptions (XML) of the commands, put together of their own and those of the programs that they run.

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

/// Options of the programs that join the stages or are for callers other than a user, and are not the user's to give.
const std::set<std::string>& stageOptions();

/// Outputs of the programs, when their options are put together.
enum class Outputs
{
  AsTexts, ///< where they go is not for the command line alone to say
  LeftOut
};

/// `command` with the options of `programs` behind its own, by mergedName(), each once, as the first program that has
/// it describes it, without stageOptions().
std::string mergedDescription(const std::string& command, const std::vector<std::string>& programs,
                              Outputs outputs = Outputs::AsTexts);

/// The name of a program's option among those put together: its own, behind the program's if an earlier program has
/// another default for it. So every default can be told and kept.
std::string mergedName(const std::string& name, const ModuleDescription& program);

/// Whether an option among those put together, where outputs are texts, is an output file of a program.
bool isOutputFile(const std::string& name);

} // namespace surgicalmesher
