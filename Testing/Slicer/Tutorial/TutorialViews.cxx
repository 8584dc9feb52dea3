// SPDX-License-Identifier: Apache-2.0
#include "TutorialViews.h"

#include "Waiting.h"

#include <qMRMLPlotView.h>
#include <qMRMLPlotWidget.h>
#include <qMRMLSliceWidget.h>
#include <qMRMLThreeDView.h>
#include <qMRMLThreeDWidget.h>
#include <qSlicerAbstractCoreModule.h>
#include <qSlicerAbstractModuleWidget.h>
#include <qSlicerApplication.h>
#include <qSlicerLayoutManager.h>
#include <qSlicerMainWindow.h>
#include <qSlicerModuleManager.h>

#include <vtkMRMLSliceCompositeNode.h>
#include <vtkMRMLSliceNode.h>
#include <vtkMRMLViewNode.h>

#include <vtkCamera.h>
#include <vtkContextScene.h>
#include <vtkMRMLScene.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>

#include <QDockWidget>
#include <QPixmap>
#include <QScreen>
#include <QScrollArea>

#include <stdexcept>

namespace surgicalmesher::test
{
namespace
{

constexpr int WINDOW_WIDTH = 1440, WINDOW_HEIGHT = 900, PANEL_WIDTH = 560;

qSlicerLayoutManager* layoutManager() { return qSlicerApplication::application()->layoutManager(); }

QMainWindow* mainWindow() { return qSlicerApplication::application()->mainWindow(); }

/// The plot views' smoothing of edges blackens the axes where OpenGL is emulated, as on a virtual display.
void keepAxesVisible()
{
  for (int i = 0; i < layoutManager()->plotViewCount(); ++i)
  {
    qMRMLPlotView* view = layoutManager()->plotWidget(i)->plotView();
    view->scene()->GetRenderer()->SetUseFXAA(false);
    view->renderWindow()->Render();
  }
}

/// Views are drawn when the host finds time; a picture waits for that.
void drawAllViews()
{
  waitFor(0.5);
  keepAxesVisible();
  for (int i = 0; i < layoutManager()->threeDViewCount(); ++i)
  {
    layoutManager()->threeDWidget(i)->threeDView()->forceRender();
  }
  waitFor(0.5);
}

} // namespace

void arrangeMainWindow()
{
  mainWindow()->showNormal();
  mainWindow()->move(0, 0);
  mainWindow()->resize(WINDOW_WIDTH, WINDOW_HEIGHT);
  waitFor(0.2);
  if (auto* panel = mainWindow()->findChild<QDockWidget*>("PanelDockWidget"))
  {
    mainWindow()->resizeDocks({ panel }, { PANEL_WIDTH }, Qt::Horizontal);
  }
  waitFor(0.5);
}

qSlicerAbstractModuleWidget* openModule(const QString& name)
{
  layoutManager()->setCurrentModule(name);
  waitFor(0.5);
  qSlicerAbstractCoreModule* module = qSlicerApplication::application()->moduleManager()->module(name);
  auto* panel = module ? dynamic_cast<qSlicerAbstractModuleWidget*>(module->widgetRepresentation()) : nullptr;
  if (!panel) throw std::runtime_error("no panel of module " + name.toStdString());
  return panel;
}

void showLayout(int layout)
{
  layoutManager()->setLayout(layout);
  waitFor(0.3);
}

void showSlicesAt(const std::array<double, 3>& point, double width)
{
  for (const QString& name : layoutManager()->sliceViewNames())
  {
    qMRMLSliceWidget* widget = layoutManager()->sliceWidget(name);
    vtkMRMLSliceNode* slice = widget->mrmlSliceNode();
    const double* size = slice->GetFieldOfView();
    slice->SetFieldOfView(width, width * size[1] / size[0], size[2]);
    slice->JumpSliceByCentering(point[0], point[1], point[2]);
  }
  waitFor(0.3);
}

void hideForeground()
{
  for (const QString& name : layoutManager()->sliceViewNames())
  {
    layoutManager()->sliceWidget(name)->mrmlSliceCompositeNode()->SetForegroundVolumeID(nullptr);
  }
}

void lookAt(const std::array<double, 3>& point, const std::array<double, 3>& direction, double height)
{
  qMRMLThreeDView* view = layoutManager()->threeDWidget(0)->threeDView();
  vtkMRMLViewNode* node = view->mrmlViewNode();
  node->SetBoxVisible(false);
  node->SetAxisLabelsVisible(false);
  node->SetRenderMode(vtkMRMLViewNode::Orthographic);
  vtkCamera* camera = view->renderWindow()->GetRenderers()->GetFirstRenderer()->GetActiveCamera();
  camera->SetFocalPoint(point.data());
  camera->SetPosition(point[0] - 500 * direction[0], point[1] - 500 * direction[1], point[2] - 500 * direction[2]);
  camera->SetViewUp(0, 0, 1);
  camera->SetParallelScale(height / 2);
  view->renderWindow()->GetRenderers()->GetFirstRenderer()->ResetCameraClippingRange();
  waitFor(0.2);
}

void scrollTo(QWidget* widget)
{
  for (QWidget* parent = widget->parentWidget(); parent; parent = parent->parentWidget())
  {
    if (auto* area = qobject_cast<QScrollArea*>(parent)) area->ensureWidgetVisible(widget, 0, 8);
  }
  waitFor(0.2);
}

void takePicture(const QString& file)
{
  drawAllViews();
  takePictureOf(mainWindow(), file);
}

void takePictureOf(QWidget* window, const QString& file)
{
  waitFor(0.3);
  const QRect frame = window->frameGeometry();
  const QPixmap picture = window->screen()->grabWindow(0, frame.x(), frame.y(), frame.width(), frame.height());
  constexpr int SMALLEST_FILE = 0;
  if (!picture.save(file, "PNG", SMALLEST_FILE)) throw std::runtime_error(file.toStdString() + ": can't be written");
}

} // namespace surgicalmesher::test
