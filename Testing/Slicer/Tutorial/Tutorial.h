// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The roads of Docs/Tutorial.md and Docs/ImageTutorial.md, walked in the host's own application by its panels' own widgets.

#include <QString>

namespace surgicalmesher::test
{

/// The host's exit status for a test that can't be made here, as CTest knows it.
constexpr int SKIPPED = 77;

/// From the atlas to files for a solver; a picture of the application into the folder at each step. Returns 0, or
/// SKIPPED if the atlas is not installed. Throws std::runtime_error if a step does not do what the tutorial says.
int walkTutorial(const QString& pictureFolder);

/// From a T1 image to a file for a solver, in the same way.
int walkImageTutorial(const QString& pictureFolder);

} // namespace surgicalmesher::test
