// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Messages of the panel about problems that prevent a run, in the user's language.

#include "vtkSlicerFuchsTetrahedralizerLogic.h"

#include <QString>

#include <functional>

/// A sentence, and the action of a button beside it that fixes the problem; without a text, there is no button.
struct Advice
{
  QString sentence;
  QString fixText;
  std::function<void(vtkMRMLFuchsTetrahedralizerNode*)> fix;
};

/// Returns the advice on a check that found a problem. `logic` offers alternatives to choose from.
Advice adviceOn(const vtkSlicerFuchsTetrahedralizerLogic::Check& check, vtkSlicerFuchsTetrahedralizerLogic* logic);
