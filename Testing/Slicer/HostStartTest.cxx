// SPDX-License-Identifier: Apache-2.0
/// The host's own application, started with our module paths as a user adds them: it finds and loads the loadable
/// modules and the command-line module of each, and its log holds no warning or error that it would not hold without us.

#include <vtkMRMLCoreTestingMacros.h>

#include <QCoreApplication>
#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QProcess>
#include <QRegularExpression>
#include <QTemporaryDir>

#include <iostream>

namespace
{

/// The log of a start and an immediate end, a line for each message: "[LEVEL] text". Empty if the host failed.
QStringList logOfStart(const QStringList& modulePaths)
{
  QTemporaryDir folder; // where the host puts its log
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert("TMPDIR", folder.path());
  QStringList arguments{ "--testing", "--no-splash", "--exit-after-startup", "--verbose-module-discovery" };
  if (!modulePaths.isEmpty()) arguments << "--additional-module-paths" << modulePaths;

  QProcess host;
  host.setProcessEnvironment(environment);
  host.setStandardOutputFile(QProcess::nullDevice());
  host.setStandardErrorFile(QProcess::nullDevice());
  host.start(SURGICALMESHER_HOST, arguments);
  if (!host.waitForFinished(300000) || host.exitCode() != 0)
  {
    std::cerr << SURGICALMESHER_HOST << ": exit status " << host.exitCode() << "\n";
    return {};
  }
  QStringList lines;
  static const QRegularExpression head("^\\[(\\w+)\\]\\[[^\\]]*\\] [^-]* - ");
  QDirIterator logs(folder.path(), { "*.log" }, QDir::Files, QDirIterator::Subdirectories);
  while (logs.hasNext())
  {
    QFile log(logs.next());
    if (!log.open(QIODevice::ReadOnly | QIODevice::Text)) continue;
    for (QString line : QString::fromUtf8(log.readAll()).split('\n')) lines << line.replace(head, "[\\1] ");
  }
  return lines;
}

QStringList complaintsIn(const QStringList& log)
{
  static const QRegularExpression complaint("^\\[(WARNING|ERROR|CRITICAL|FATAL)\\]");
  return log.filter(complaint);
}

/// Whether the host takes a file of this name for a module of this kind.
bool isRecognized(const QStringList& log, const QString& file, const QString& factory)
{
  const QStringList lines = log.filter("recognized file").filter("/" + file);
  return !lines.filter(factory).isEmpty();
}

} // namespace

int HostStartTest(int argc, char* argv[])
{
  QCoreApplication application(argc, argv);
  const QStringList log = logOfStart({ SURGICALMESHER_LOADABLE_MODULES, SURGICALMESHER_CLI_MODULES });
  CHECK_BOOL(log.isEmpty(), false);
  const std::pair<QString, QString> modules[] = { { "SurgicalPathScale", "SurgicalPathScaleCLI" },
                                                  { "SimplexMesher", "SimplexMesherCLI" },
                                                  { "FuchsTetrahedralizer", "FuchsTetrahedralizerCLI" },
                                                  { "TissueMapper", "TissueMapperCLI" },
                                                  { "TemplateHexMesher", "TemplateFitCLI" } };
  for (const auto& [name, program] : modules)
  {
    std::cout << name.toStdString() << "\n";
    CHECK_BOOL(isRecognized(log, "libqSlicer" + name + "Module", "qSlicerLoadableModuleFactory"), true);
    CHECK_BOOL(isRecognized(log, program, "qSlicerCLIExecutableModuleFactory"), true);
    CHECK_INT(log.filter("Loading module \"" + name + "\"").size(), 1);
    CHECK_INT(log.filter("Loading module \"" + program + "\"").size(), 1);
  }
  const QStringList usual = complaintsIn(logOfStart({}));
  QStringList ours;
  for (const QString& line : complaintsIn(log))
  {
    if (!usual.contains(line)) ours << line;
  }
  CHECK_STD_STRING(ours.join("\n").toStdString(), "");
  return EXIT_SUCCESS;
}
