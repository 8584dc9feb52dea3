// SPDX-License-Identifier: Apache-2.0
#include "SeparateProcess.h"

#include "Errors.h"
#include "Parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>
#ifndef _WIN32
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace surgicalmesher
{
namespace
{

TEST(SeparateProcess, AnswersOrTellsThatThereIsNoAnswer)
{
  const std::string large(1 << 20, 'x'); // more than a pipe holds
  EXPECT_EQ(runInSeparateProcess([&] { return large; }), large);
  EXPECT_EQ(runInSeparateProcess([] { return std::string(); }), "") << "an answer as well";
  EXPECT_EQ(runInSeparateProcess([]() -> std::string { throw 2; }), std::nullopt);
#ifndef _WIN32
  EXPECT_EQ(runInSeparateProcess([]() -> std::string { std::abort(); }), std::nullopt);
  const auto endless = []() -> std::string
  {
    for (volatile unsigned n = 0;; n = n + 1)
    {
    }
  };
  EXPECT_EQ(runInSeparateProcess(endless, 1), std::nullopt);
  EXPECT_EQ(runInSeparateProcess([&] { return large; }, 1), large);
  EXPECT_EQ(runInSeparateProcess([]() -> std::string { std::_Exit(0); }), std::nullopt) << "left without an answer";
#endif
}

TEST(SeparateProcess, SeveralRunAtOnceAndNobodyWaitsForTheUnasked)
{
  std::string seen = "before";
  SeparateProcess first([&] { return seen; });
  seen = "between";
  SeparateProcess second([&] { return seen; });
#ifndef _WIN32 // where work begins when it is asked for
  EXPECT_EQ(second.answer(), "between");
  EXPECT_EQ(first.answer(), "before");
  { // ends here, although pause() never does
    const SeparateProcess unasked([] { return std::to_string(pause()); });
  }
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "no process is left behind";
#endif
}

#ifndef _WIN32
/// As whoever starts a program may leave it: while this lives, SIGALRM is ignored, and blocked.
class NoAlarms
{
public:
  NoAlarms() : m_Before(std::signal(SIGALRM, SIG_IGN))
  {
    sigset_t alarms;
    sigemptyset(&alarms);
    sigaddset(&alarms, SIGALRM);
    pthread_sigmask(SIG_BLOCK, &alarms, &m_Blocked);
  }
  ~NoAlarms()
  {
    pthread_sigmask(SIG_SETMASK, &m_Blocked, nullptr);
    std::signal(SIGALRM, m_Before);
  }
  NoAlarms(const NoAlarms&) = delete;
  void operator=(const NoAlarms&) = delete;

private:
  void (*m_Before)(int);
  sigset_t m_Blocked{};
};

TEST(SeparateProcess, WhatWaitsTooLongEndsWhateverHasBecomeOfAlarms)
{
  const NoAlarms here;
  const std::string large(1 << 20, 'x'); // its process waits until it is read
  SeparateProcess patient([&] { return large; }, 1);
  const auto sleeping = []() -> std::string { return std::to_string(sleep(30)); }; // that uses no processor time
  EXPECT_EQ(runInSeparateProcess(sleeping, 1), std::nullopt);
  EXPECT_EQ(patient.answer(), large) << "waits as long, but its work was done";
}

TEST(SeparateProcess, OneThatAnotherThreadStartsDoesNotHideACrash)
{
  for (int time = 0; time < 200; ++time)
  {
    std::atomic<int> ready{ 0 };
    const auto meet = [&]
    {
      for (++ready; ready < 2;)
      {
      }
    };
    std::unique_ptr<SeparateProcess> endless;
    std::thread other(
      [&]
      {
        meet();
        endless = std::make_unique<SeparateProcess>([] { return std::to_string(sleep(3600)); });
        while (ready < 3) sched_yield(); // Linux ends a child with the thread that started it
      });
    meet();
    EXPECT_EQ(runInSeparateProcess([]() -> std::string { std::_Exit(1); }), std::nullopt); // else waits for the other
    ready = 3;
    other.join();
  }
}

TEST(SeparateProcess, WhatCannotBeStartedIsNoMissingAnswer)
{
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  const rlimit none{ 0, before.rlim_max };
  setrlimit(RLIMIT_NOFILE, &none);
  EXPECT_THROW(runInSeparateProcess([] { return std::string(); }), EngineError);
  setrlimit(RLIMIT_NOFILE, &before);
}

void loopInParallel(int times)
{
  std::vector<double> values(4000);
  for (int time = 0; time < times; ++time) parallelFor(values.size(), [&](std::size_t i) { values[i] += double(i); });
}

TEST(SeparateProcess, LoopsDoWithoutThreadsThatStayedBehind)
{
  EXPECT_EQ(runInSeparateProcess([] { return std::string(vtkSMPTools::GetBackend()); }), "Sequential");

  std::atomic<bool> done{ false };
  std::thread busy( // so that what threads share is held by one of them at any moment
    [&]
    {
      while (!done) loopInParallel(1);
    });
  constexpr int processes = 100;
  int answers = 0;
  while (answers < processes && runInSeparateProcess([] { return loopInParallel(100), std::string(); }, 1)) ++answers;
  done = true;
  busy.join();
  EXPECT_EQ(answers, processes);
}
#endif

} // namespace
} // namespace surgicalmesher
