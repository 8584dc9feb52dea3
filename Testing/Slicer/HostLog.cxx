// SPDX-License-Identifier: Apache-2.0
#include "HostLog.h"

#include "Waiting.h"

#include <qSlicerApplication.h>

#include <ctkErrorLogAbstractModel.h>

#include <QRegularExpression>

namespace surgicalmesher::test
{
namespace
{

bool isComplaint(const QString& level)
{
  return level == "Warning" || level == "Error" || level == "Critical" || level == "Fatal";
}

/// What the host itself does is not ours to mend: Slicer 5.0 draws curves by a filter that VTK 9.1 has deprecated, and
/// after a scene was closed it takes a new node at the address of an old one for that one, corrects itself and says so.
bool isHosts(const QString& text)
{
  return text.contains("vtkPassThroughFilter was deprecated") || text.contains("DataNodeCache inconsistency found");
}

} // namespace

std::string HostLog::complaints()
{
  waitFor(0.1); // messages of other threads reach the log as events
  const ctkErrorLogAbstractModel& log = *qSlicerApplication::application()->errorLogModel();
  const bool isStart = m_EntriesSeen == 0;
  static const QRegularExpression ours(
    "SurgicalPathScale|SimplexMesher|FuchsTetrahedralizer|TissueMapper|TemplateHexMesher|TemplateFit|SurgicalMesher");
  QString lines;
  for (; m_EntriesSeen < log.logEntryCount(); ++m_EntriesSeen)
  {
    const QString level = log.logEntryData(m_EntriesSeen, ctkErrorLogAbstractModel::LogLevelColumn).toString();
    const QString text = log.logEntryDescription(m_EntriesSeen);
    if (isComplaint(level) && !isHosts(text) && (!isStart || text.contains(ours))) lines += level + ": " + text + "\n";
  }
  return lines.toStdString();
}

} // namespace surgicalmesher::test
