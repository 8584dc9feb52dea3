// SPDX-License-Identifier: Apache-2.0
#include "vtkMRMLSimplexMesherNode.h"

#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLPlotChartNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLTableNode.h>

#include <vtkObjectFactory.h>

#include <array>
#include <locale>
#include <sstream>
#include <tuple>
#include <utility>
#include <vector>

using surgicalmesher::TissueRole;
using surgicalmesher::TissueSetting;

namespace
{

constexpr std::array<const char*, 4> roleNames{ "mesh", "group", "shell", "leave" }; // by TissueRole

std::string escaped(const std::string& text)
{
  std::string result;
  for (const char c : text)
  {
    if (c == '%') result += "%25";
    else if (c == '|') result += "%7C";
    else if (c == ';') result += "%3B";
    else result += c;
  }
  return result;
}

std::string unescaped(std::string text)
{
  const std::array<std::pair<const char*, const char*>, 3> codes{ { { "%7C", "|" }, { "%3B", ";" }, { "%25", "%" } } };
  for (const auto& [code, character] : codes) // the percent sign last: it makes no new codes then
  {
    for (std::size_t at = text.find(code); at != std::string::npos; at = text.find(code, at + 1))
      text.replace(at, 3, character);
  }
  return text;
}

std::vector<std::string> split(const std::string& text, char end)
{
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, end);) parts.push_back(part);
  return parts;
}

double number(const std::string& text)
{
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double value = 0;
  stream >> value;
  return value;
}

auto fields(const TissueSetting& s)
{
  return std::tie(s.role, s.group, s.minimumEdgeLength, s.maximumEdgeLength, s.isProtected, s.islandVolume,
                  s.cavityVolume);
}

bool isDefault(const TissueSetting& setting) { return fields(setting) == fields(TissueSetting()); }

TissueRole roleOf(const std::string& name)
{
  for (std::size_t role = 0; role < roleNames.size(); ++role)
  {
    if (name == roleNames[role]) return TissueRole(role);
  }
  return TissueRole::Mesh;
}

} // namespace

vtkMRMLNodeNewMacro(vtkMRMLSimplexMesherNode);

const char* vtkMRMLSimplexMesherNode::TissueMapRole() { return "tissueMap"; }
const char* vtkMRMLSimplexMesherNode::ScaleRole() { return "scale"; }
const char* vtkMRMLSimplexMesherNode::SurfaceRole() { return "surface"; }
const char* vtkMRMLSimplexMesherNode::PreparedLabelMapRole() { return "preparedLabelMap"; }
const char* vtkMRMLSimplexMesherNode::SimplexMeshRole() { return "simplexMesh"; }
const char* vtkMRMLSimplexMesherNode::FollowedScaleRole() { return "followedScale"; }
const char* vtkMRMLSimplexMesherNode::TissueTableRole() { return "tissueTable"; }
const char* vtkMRMLSimplexMesherNode::EvolutionTableRole() { return "evolutionTable"; }
const char* vtkMRMLSimplexMesherNode::EvolutionChartRole() { return "evolutionChart"; }
const char* vtkMRMLSimplexMesherNode::AmbientTetrahedraRole() { return "ambientTetrahedra"; }

vtkMRMLSimplexMesherNode::vtkMRMLSimplexMesherNode()
{
  this->HideFromEditors = 1;
  for (const char* role : { TissueMapRole(), ScaleRole(), SurfaceRole(), PreparedLabelMapRole(), SimplexMeshRole(),
                            FollowedScaleRole(), TissueTableRole(), EvolutionTableRole(), EvolutionChartRole() })
  {
    this->AddNodeReferenceRole(role, (std::string(role) + "NodeRef").c_str());
  }
}

void vtkMRMLSimplexMesherNode::ReadXMLAttributes(const char** atts)
{
  const int wasModifying = this->StartModify();
  Superclass::ReadXMLAttributes(atts);
  vtkMRMLReadXMLBeginMacro(atts);
  vtkMRMLReadXMLBooleanMacro(useScale, UseScale);
  vtkMRMLReadXMLFloatMacro(edgeLength, EdgeLength);
  vtkMRMLReadXMLFloatMacro(minimumIslandVolume, MinimumIslandVolume);
  vtkMRMLReadXMLFloatMacro(minimumCavityVolume, MinimumCavityVolume);
  vtkMRMLReadXMLFloatMacro(featureScale, FeatureScale);
  vtkMRMLReadXMLFloatMacro(maximumDistance, MaximumDistance);
  vtkMRMLReadXMLBooleanMacro(followThickness, FollowThickness);
  vtkMRMLReadXMLFloatMacro(gradation, Gradation);
  vtkMRMLReadXMLIntMacro(threads, Threads);
  vtkMRMLReadXMLBooleanMacro(tissueModels, TissueModels);
  vtkMRMLReadXMLBooleanMacro(keepAmbient, KeepAmbient);
  vtkMRMLReadXMLBooleanMacro(report, Report);
  vtkMRMLReadXMLStdStringMacro(tissues, Tissues);
  vtkMRMLReadXMLEndMacro();
  this->EndModify(wasModifying);
}

void vtkMRMLSimplexMesherNode::WriteXML(ostream& of, int indent)
{
  Superclass::WriteXML(of, indent);
  const std::streamsize precision = of.precision(15); // lengths come back as they were
  vtkMRMLWriteXMLBeginMacro(of);
  vtkMRMLWriteXMLBooleanMacro(useScale, UseScale);
  vtkMRMLWriteXMLFloatMacro(edgeLength, EdgeLength);
  vtkMRMLWriteXMLFloatMacro(minimumIslandVolume, MinimumIslandVolume);
  vtkMRMLWriteXMLFloatMacro(minimumCavityVolume, MinimumCavityVolume);
  vtkMRMLWriteXMLFloatMacro(featureScale, FeatureScale);
  vtkMRMLWriteXMLFloatMacro(maximumDistance, MaximumDistance);
  vtkMRMLWriteXMLBooleanMacro(followThickness, FollowThickness);
  vtkMRMLWriteXMLFloatMacro(gradation, Gradation);
  vtkMRMLWriteXMLIntMacro(threads, Threads);
  vtkMRMLWriteXMLBooleanMacro(tissueModels, TissueModels);
  vtkMRMLWriteXMLBooleanMacro(keepAmbient, KeepAmbient);
  vtkMRMLWriteXMLBooleanMacro(report, Report);
  vtkMRMLWriteXMLStdStringMacro(tissues, Tissues);
  vtkMRMLWriteXMLEndMacro();
  of.precision(precision);
}

void vtkMRMLSimplexMesherNode::CopyContent(vtkMRMLNode* node, bool deepCopy)
{
  MRMLNodeModifyBlocker blocker(this);
  Superclass::CopyContent(node, deepCopy);
  vtkMRMLCopyBeginMacro(node);
  vtkMRMLCopyBooleanMacro(UseScale);
  vtkMRMLCopyFloatMacro(EdgeLength);
  vtkMRMLCopyFloatMacro(MinimumIslandVolume);
  vtkMRMLCopyFloatMacro(MinimumCavityVolume);
  vtkMRMLCopyFloatMacro(FeatureScale);
  vtkMRMLCopyFloatMacro(MaximumDistance);
  vtkMRMLCopyBooleanMacro(FollowThickness);
  vtkMRMLCopyFloatMacro(Gradation);
  vtkMRMLCopyIntMacro(Threads);
  vtkMRMLCopyBooleanMacro(TissueModels);
  vtkMRMLCopyBooleanMacro(KeepAmbient);
  vtkMRMLCopyBooleanMacro(Report);
  vtkMRMLCopyStdStringMacro(Tissues);
  vtkMRMLCopyEndMacro();
}

void vtkMRMLSimplexMesherNode::PrintSelf(ostream& os, vtkIndent indent)
{
  Superclass::PrintSelf(os, indent);
  vtkMRMLPrintBeginMacro(os, indent);
  vtkMRMLPrintBooleanMacro(UseScale);
  vtkMRMLPrintFloatMacro(EdgeLength);
  vtkMRMLPrintFloatMacro(MinimumIslandVolume);
  vtkMRMLPrintFloatMacro(MinimumCavityVolume);
  vtkMRMLPrintFloatMacro(FeatureScale);
  vtkMRMLPrintFloatMacro(MaximumDistance);
  vtkMRMLPrintBooleanMacro(FollowThickness);
  vtkMRMLPrintFloatMacro(Gradation);
  vtkMRMLPrintIntMacro(Threads);
  vtkMRMLPrintBooleanMacro(TissueModels);
  vtkMRMLPrintBooleanMacro(KeepAmbient);
  vtkMRMLPrintBooleanMacro(Report);
  vtkMRMLPrintStdStringMacro(Tissues);
  vtkMRMLPrintEndMacro();
}

vtkMRMLNode* vtkMRMLSimplexMesherNode::GetTissueMapNode() { return this->GetNodeReference(TissueMapRole()); }

vtkMRMLScalarVolumeNode* vtkMRMLSimplexMesherNode::GetScaleNode()
{
  return vtkMRMLScalarVolumeNode::SafeDownCast(this->GetNodeReference(ScaleRole()));
}

vtkMRMLModelNode* vtkMRMLSimplexMesherNode::GetSurfaceNode()
{
  return vtkMRMLModelNode::SafeDownCast(this->GetNodeReference(SurfaceRole()));
}

vtkMRMLLabelMapVolumeNode* vtkMRMLSimplexMesherNode::GetPreparedLabelMapNode()
{
  return vtkMRMLLabelMapVolumeNode::SafeDownCast(this->GetNodeReference(PreparedLabelMapRole()));
}

vtkMRMLModelNode* vtkMRMLSimplexMesherNode::GetSimplexMeshNode()
{
  return vtkMRMLModelNode::SafeDownCast(this->GetNodeReference(SimplexMeshRole()));
}

vtkMRMLScalarVolumeNode* vtkMRMLSimplexMesherNode::GetFollowedScaleNode()
{
  return vtkMRMLScalarVolumeNode::SafeDownCast(this->GetNodeReference(FollowedScaleRole()));
}

vtkMRMLTableNode* vtkMRMLSimplexMesherNode::GetTissueTableNode()
{
  return vtkMRMLTableNode::SafeDownCast(this->GetNodeReference(TissueTableRole()));
}

vtkMRMLTableNode* vtkMRMLSimplexMesherNode::GetEvolutionTableNode()
{
  return vtkMRMLTableNode::SafeDownCast(this->GetNodeReference(EvolutionTableRole()));
}

vtkMRMLPlotChartNode* vtkMRMLSimplexMesherNode::GetEvolutionChartNode()
{
  return vtkMRMLPlotChartNode::SafeDownCast(this->GetNodeReference(EvolutionChartRole()));
}

void vtkMRMLSimplexMesherNode::SetNode(const char* role, vtkMRMLNode* node)
{
  this->SetNodeReferenceID(role, node ? node->GetID() : nullptr);
}

void vtkMRMLSimplexMesherNode::SetTissueSettings(const Settings& settings)
{
  const std::string before = this->GetTissues();
  Settings asked;
  for (const auto& [id, setting] : settings)
  {
    if (!isDefault(setting)) asked[id] = setting;
  }
  this->TissueSettings = asked;
  if (this->GetTissues() != before) this->Modified();
}

TissueSetting vtkMRMLSimplexMesherNode::GetTissueSetting(const std::string& id) const
{
  const auto found = this->TissueSettings.find(id);
  return found == this->TissueSettings.end() ? TissueSetting() : found->second;
}

void vtkMRMLSimplexMesherNode::SetTissueSetting(const std::string& id, const TissueSetting& setting)
{
  Settings settings = this->TissueSettings;
  settings[id] = setting;
  this->SetTissueSettings(settings);
}

std::string vtkMRMLSimplexMesherNode::GetTissues() const
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  for (const auto& [id, setting] : this->TissueSettings)
  {
    text << escaped(id) << '|' << roleNames[std::size_t(setting.role)] << '|' << escaped(setting.group) << '|'
         << setting.minimumEdgeLength << '|' << setting.maximumEdgeLength << '|' << (setting.isProtected ? "yes" : "no")
         << '|' << setting.islandVolume << '|' << setting.cavityVolume << ';';
  }
  return text.str();
}

void vtkMRMLSimplexMesherNode::SetTissues(const std::string& text)
{
  Settings settings;
  for (const std::string& record : split(text, ';'))
  {
    const std::vector<std::string> field = split(record, '|');
    if (field.size() != 8) continue;
    TissueSetting setting;
    setting.role = roleOf(field[1]);
    setting.group = unescaped(field[2]);
    setting.minimumEdgeLength = number(field[3]);
    setting.maximumEdgeLength = number(field[4]);
    setting.isProtected = field[5] == "yes";
    setting.islandVolume = number(field[6]);
    setting.cavityVolume = number(field[7]);
    settings[unescaped(field[0])] = setting;
  }
  this->SetTissueSettings(settings);
}
