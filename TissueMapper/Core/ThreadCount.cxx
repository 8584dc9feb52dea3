// SPDX-License-Identifier: Apache-2.0
#include "ThreadCount.h"

#include <itkMultiThreaderBase.h>
#include <vtkSMPTools.h>

namespace surgicalmesher
{

void setThreadCount(int count)
{
  vtkSMPTools::Initialize(count);
  if (count > 0) itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(itk::ThreadIdType(count));
}

OneWorkUnit::OneWorkUnit() : m_Before(itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads())
{
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(1);
}

OneWorkUnit::~OneWorkUnit() { itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(m_Before); }

} // namespace surgicalmesher
