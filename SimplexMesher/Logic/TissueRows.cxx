// SPDX-License-Identifier: Apache-2.0
#include "TissueRows.h"

#include "TissueMapInput.h"

#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLSegmentationNode.h>

#include <vtkOrientedImageData.h>
#include <vtkSegment.h>
#include <vtkSegmentation.h>
#include <vtkSegmentationConverter.h>

#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <cmath>

namespace surgicalmesher
{
namespace
{

template <typename Value>
void addVoxels(const Value* begin, const Value* end, std::vector<std::int64_t>& counts)
{
  for (const Value* v = begin; v != end; ++v)
  {
    if (*v > 0 && double(*v) <= 65535 && Value(std::size_t(*v)) == *v) ++counts[std::size_t(*v)];
  }
}

double volumeOf(const double spacing[3]) { return std::abs(spacing[0] * spacing[1] * spacing[2]); }

std::vector<TissueRow> listLabels(vtkMRMLLabelMapVolumeNode* map)
{
  std::vector<TissueRow> rows;
  const TissueTable table = tissueTable(map);
  for (const auto& [label, voxels] : countVoxels(map->GetImageData()))
  {
    TissueRow row;
    row.id = std::to_string(label);
    row.label = label;
    row.voxels = voxels;
    row.volume = double(voxels) * volumeOf(map->GetSpacing());
    rows.push_back(row);
  }
  for (TissueRow& row : rows)
  {
    const auto found = table.find(row.label);
    if (found != table.end()) row.color = found->second.color;
    row.name = found != table.end() && !found->second.name.empty() ? found->second.name : row.id;
  }
  return rows;
}

/// Segments may share an image with different values, so that each image is counted only once.
std::vector<TissueRow> listSegments(vtkSegmentation* segmentation)
{
  std::map<vtkOrientedImageData*, std::map<Label, std::int64_t>> counted;
  std::vector<TissueRow> rows;
  for (int i = 0; i < segmentation->GetNumberOfSegments(); ++i)
  {
    vtkSegment* segment = segmentation->GetNthSegment(i);
    TissueRow row;
    row.id = segmentation->GetNthSegmentID(i);
    row.label = Label(i + 1);
    row.name = segment->GetName() ? segment->GetName() : row.id;
    segment->GetColor(row.color.data());
    auto* image = vtkOrientedImageData::SafeDownCast(
      segment->GetRepresentation(vtkSegmentationConverter::GetSegmentationBinaryLabelmapRepresentationName()));
    if (image)
    {
      if (counted.count(image) == 0) counted[image] = countVoxels(image);
      row.voxels = counted[image][Label(segment->GetLabelValue())];
      row.volume = double(row.voxels) * volumeOf(image->GetSpacing());
    }
    rows.push_back(row);
  }
  return rows;
}

} // namespace

std::map<Label, std::int64_t> countVoxels(vtkImageData* image)
{
  std::map<Label, std::int64_t> result;
  vtkDataArray* scalars = image ? image->GetPointData()->GetScalars() : nullptr;
  if (!scalars || scalars->GetNumberOfComponents() != 1) return result;
  std::vector<std::int64_t> counts(65536);
  switch (scalars->GetDataType())
  {
    vtkTemplateMacro(addVoxels(static_cast<VTK_TT*>(scalars->GetVoidPointer(0)),
                               static_cast<VTK_TT*>(scalars->GetVoidPointer(0)) + scalars->GetNumberOfTuples(),
                               counts));
  }
  for (std::size_t label = 1; label < counts.size(); ++label)
  {
    if (counts[label] > 0) result[Label(label)] = counts[label];
  }
  return result;
}

std::vector<TissueRow> listTissues(vtkMRMLNode* tissueMap)
{
  if (auto* map = vtkMRMLLabelMapVolumeNode::SafeDownCast(tissueMap)) return listLabels(map);
  auto* node = vtkMRMLSegmentationNode::SafeDownCast(tissueMap);
  return node && node->GetSegmentation() ? listSegments(node->GetSegmentation()) : std::vector<TissueRow>();
}

} // namespace surgicalmesher
