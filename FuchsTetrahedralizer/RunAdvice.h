// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the panel says of a problem that keeps it from being run, in the user's language.

#include "vtkSlicerFuchsTetrahedralizerLogic.h"

#include <QString>

#include <functional>

/// A sentence, and what a button beside it does about the problem; without a text there is no button.
struct Advice
{
  QString sentence;
  QString fixText;
  std::function<void(vtkMRMLFuchsTetrahedralizerNode*)> fix;
};

/// `check` has a problem. `logic` offers what else could be chosen.
Advice adviceOn(const vtkSlicerFuchsTetrahedralizerLogic::Check& check, vtkSlicerFuchsTetrahedralizerLogic* logic);
