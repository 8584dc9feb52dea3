// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The application's window and views, as the tutorial's pictures show them.

#include <array>

#include <QString>

class QWidget;
class qSlicerAbstractModuleWidget;

namespace surgicalmesher::test
{

/// Sizes and places the main window so that a picture of it is legible in a page.
void arrangeMainWindow();

/// A module by the main window's own selector. Throws std::runtime_error if it has no panel.
qSlicerAbstractModuleWidget* openModule(const QString& name);

/// A layout of views, one of vtkMRMLLayoutNode's.
void showLayout(int layout);

/// Slice views to this point (RAS, mm), with so many mm across the width of each.
void showSlicesAt(const std::array<double, 3>& point, double width);

/// Takes the foreground out of the slice views, and its legend with it.
void hideForeground();

/// The first three-dimensional view: camera on `point`, looking along `direction`, so many mm from top to bottom.
void lookAt(const std::array<double, 3>& point, const std::array<double, 3>& direction, double height);

/// Brings a widget of a panel into the visible part of it.
void scrollTo(QWidget* widget);

/// What the screen shows of the main window, once all views are drawn, as a PNG file.
void takePicture(const QString& file);

/// The same of a dialogue or any other window.
void takePictureOf(QWidget* window, const QString& file);

} // namespace surgicalmesher::test
