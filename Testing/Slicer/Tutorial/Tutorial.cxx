#include "Tutorial.h"

#include "HostScene.h"
#include "TutorialViews.h"
#include "Waiting.h"

#include <qMRMLNodeComboBox.h>
#include <qSlicerAbstractModuleWidget.h>
#include <qSlicerApplication.h>

#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLLayoutNode.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSegmentationDisplayNode.h>
#include <vtkMRMLSegmentationNode.h>

#include <QDir>

#include <stdexcept>

namespace surgicalmesher::test
{
namespace
{

constexpr Point SELLA{ 0, 0, -10 }; ///< near the pituitary gland, RAS

class Tutorial
{
public:
  explicit Tutorial(const QString& folder) : m_Folder(folder) { QDir().mkpath(folder); }

  void walk()
  {
    arrangeMainWindow();
    loadSegmentation();
  }

private:
  vtkMRMLScene* scene() const { return qSlicerApplication::application()->mrmlScene(); }

  void take(const QString& name) { takePicture(m_Folder + "/tutorial-" + name + ".png"); }

  void loadSegmentation()
  {
    vtkMRMLLabelMapVolumeNode* atlas = loadLabelMap(scene(), jhuAtlasFile());
    m_Segmentation = addSegmentation(scene(), atlas, "Brain");
    scene()->RemoveNode(atlas);
    vtkMRMLSegmentationDisplayNode::SafeDownCast(m_Segmentation->GetDisplayNode())->SetOpacity2DFill(0.6);
    openModule("Segmentations");
    showLayout(vtkMRMLLayoutNode::SlicerLayoutFourUpView);
    showSlicesAt(SELLA, 180);
    take("1-segmentation");
  }

  QString m_Folder;
  vtkMRMLSegmentationNode* m_Segmentation = nullptr;
};

} // namespace

int walkTutorial(const QString& pictureFolder)
{
  if (jhuAtlasFile().empty()) return SKIPPED;
  Tutorial(pictureFolder).walk();
  return 0;
}

} // namespace surgicalmesher::test
