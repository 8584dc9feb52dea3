// SPDX-License-Identifier: Apache-2.0
#include "vtkMRMLSimplexMesherNode.h"

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

constexpr std::array<const char*, 4> roleNames{ "mesh", "group", "shell", "leave" }; // indexed by TissueRole

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
  for (const auto& [code, character] : codes) // the percent sign last, so that it forms no new codes
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

vtkMRMLSimplexMesherNode::vtkMRMLSimplexMesherNode()
{
  this->AddRoles({ TissueMapRole(), ScaleRole(), SurfaceRole(), PreparedLabelMapRole(), SimplexMeshRole(),
                   FollowedScaleRole(), TissueTableRole(), EvolutionTableRole(), ShapeTableRole(), FoldTableRole(),
                   EarTableRole(), EvolutionChartRole(), BalloonSeedsRole(), BalloonSurfaceRole(),
                   BalloonLabelMapRole() },
                 "NodeRef");
}

std::vector<vtkMRMLSurgicalMesherParameterNode::Value> vtkMRMLSimplexMesherNode::GetValues()
{
  const Text tissues{ [this] { return this->GetTissues(); }, [this](const std::string& t) { this->SetTissues(t); } };
  const Text stops{ [this] { return this->GetStops(); }, [this](const std::string& t) { this->SetStops(t); } };
  return { { "useScale", &this->UseScale },
           { "edgeLength", &this->EdgeLength },
           { "minimumIslandVolume", &this->MinimumIslandVolume },
           { "minimumCavityVolume", &this->MinimumCavityVolume },
           { "featureScale", &this->FeatureScale },
           { "smoothing", &this->Smoothing },
           { "rigidity", &this->Rigidity },
           { "continuity", Choice{ &this->Continuity, { "C0", "C1", "C2" } } },
           { "maximumDistance", &this->MaximumDistance },
           { "proximityNear", &this->ProximityNear },
           { "proximityFar", &this->ProximityFar },
           { "chordError", &this->ChordError },
           { "background", &this->Background },
           { "followThickness", &this->FollowThickness },
           { "gradation", &this->Gradation },
           { "threads", &this->Threads },
           { "tissueModels", &this->TissueModels },
           { "keepAmbient", &this->KeepAmbient },
           { "report", &this->Report },
           { "tissues", tissues },
           { "balloonStops", stops },
           { "balloonLimit", &this->BalloonLimit },
           { "balloonRigidity", &this->BalloonRigidity } };
}

void vtkMRMLSimplexMesherNode::SetContinuity(int continuity)
{
  if (continuity == this->Continuity || continuity < 0 || continuity >= Continuity_Last) return;
  this->Continuity = continuity;
  this->Modified();
}

void vtkMRMLSimplexMesherNode::SetBalloonStops(const std::set<std::string>& ids)
{
  if (ids == this->BalloonStops) return;
  this->BalloonStops = ids;
  this->Modified();
}

std::string vtkMRMLSimplexMesherNode::GetStops() const
{
  std::string text;
  for (const std::string& id : this->BalloonStops) text += escaped(id) + ';';
  return text;
}

void vtkMRMLSimplexMesherNode::SetStops(const std::string& text)
{
  std::set<std::string> ids;
  for (const std::string& id : split(text, ';')) ids.insert(unescaped(id));
  this->SetBalloonStops(ids);
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
