// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The panel of Tissue Mapper in a test, by what a user does with it.

#include "HeadPhantom.h"
#include "HostApplication.h"
#include "qSurgicalMesherRunWidget.h"
#include "vtkMRMLTissueMapperNode.h"
#include "vtkSlicerTissueMapperLogic.h"
#include "vtkSurgicalMesherRun.h"

#include <qMRMLNodeComboBox.h>
#include <qSlicerAbstractModuleWidget.h>

#include <vtkMRMLCommandLineModuleNode.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>

#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkTypeTraits.h>

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

#include <algorithm>

namespace surgicalmesher::test
{

struct Panel
{
  HostApplication& host;
  qSlicerAbstractModuleWidget* widget = host.enterPanel("TissueMapper");
  vtkSlicerTissueMapperLogic* logic = vtkSlicerTissueMapperLogic::SafeDownCast(host.logic("TissueMapper"));
  /// The section that is looked at, by its foot and its run.
  const char* footName = "RunWidget";
  vtkSurgicalMesherRun* run = logic->GetRun(vtkSlicerTissueMapperLogic::Classify);

  vtkMRMLTissueMapperNode* node() const { return logic->ParameterNode(); }
  template <class Child>
  Child* child(const char* name) const
  {
    return findChild<Child>(widget, name);
  }
  qSurgicalMesherRunWidget* foot() const { return child<qSurgicalMesherRunWidget>(footName); }
  QPushButton* button(const char* name) const { return findChild<QPushButton>(foot(), name); }
  void choose(const char* selector, vtkMRMLNode* chosen) const
  {
    child<qMRMLNodeComboBox>(selector)->setCurrentNode(chosen);
  }
  void chooseClass(const std::string& name) const
  {
    child<QComboBox>("ClassComboBox")->lineEdit()->setText(QString::fromStdString(name));
  }
  std::string problem() const { return foot()->problem().toStdString(); }
  std::string sentence() const { return findChild<QLabel>(foot(), "RunSentence")->text().toStdString(); }
  void fix() const { button("FixButton")->click(); }
  void apply() const { button("ApplyButton")->click(); }
  bool waitForEnd() const
  {
    return host.waitUntil([this] { return !run->IsBusy(); });
  }
};

/// A volume whose axes are those of LPS.
template <class VolumeNode, class T>
VolumeNode* addVolume(vtkMRMLScene* scene, const char* name, const Grid& grid, const std::vector<T>& values)
{
  vtkNew<vtkImageData> voxels;
  voxels->SetDimensions(grid.size.data());
  voxels->AllocateScalars(vtkTypeTraits<T>::VTKTypeID(), 1);
  std::copy(values.begin(), values.end(), static_cast<T*>(voxels->GetScalarPointer()));
  vtkNew<vtkMatrix4x4> matrix;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int sign = axis < 2 ? -1 : 1;
    matrix->SetElement(axis, axis, sign * grid.spacing[axis]);
    matrix->SetElement(axis, 3, sign * grid.origin[axis]);
  }
  vtkNew<VolumeNode> volume; // it has its voxels before it enters the scene
  volume->SetName(name);
  volume->SetIJKToRASMatrix(matrix);
  volume->SetAndObserveImageData(voxels);
  scene->AddNode(volume);
  volume->CreateDefaultDisplayNodes();
  return volume;
}

inline vtkMRMLScalarVolumeNode* addVolume(vtkMRMLScene* scene, const char* name, const ScalarImage& image)
{
  return addVolume<vtkMRMLScalarVolumeNode>(scene, name, image.grid, image.values);
}

} // namespace surgicalmesher::test
