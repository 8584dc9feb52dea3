// SPDX-License-Identifier: Apache-2.0
#include "Waiting.h"

#include <QElapsedTimer>
#include <QEventLoop>
#include <QTimer>

namespace surgicalmesher::test
{

bool waitUntil(const std::function<bool()>& condition, double seconds)
{
  QElapsedTimer time;
  time.start();
  while (!condition())
  {
    if (time.elapsed() > 1000 * seconds) return false;
    QEventLoop loop;
    QTimer::singleShot(20, &loop, &QEventLoop::quit);
    loop.exec();
  }
  return true;
}

void waitFor(double seconds)
{
  waitUntil([] { return false; }, seconds);
}

} // namespace surgicalmesher::test
