#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <iostream>

#include "host/cli/run_program.h"

namespace edgescout::test {
namespace {

// A process that has loaded the libraries of the program and done nothing else. Each of its forks
// is the program: it starts within milliseconds, the file of the program takes a third of a second.
class ProgramForks {
 public:
  ProgramForks() {
    if (::pipe2(requests_, O_CLOEXEC) != 0 || ::pipe2(replies_, O_CLOEXEC) != 0) std::abort();
    server_ = ::fork();
    if (server_ == 0) serve();
    ::close(requests_[0]);
    ::close(replies_[1]);
  }
  ProgramForks(const ProgramForks&) = delete;
  ProgramForks& operator=(const ProgramForks&) = delete;
  ~ProgramForks() {
    ::close(requests_[1]);  // the end of what it reads
    ::close(replies_[0]);
    ::waitpid(server_, nullptr, 0);
  }
  // `folder` holds the arguments and gets what is printed. The status is that of waitpid.
  int status_of(const std::filesystem::path& folder) {
    const std::string line = folder.string() + "\n";
    int status = -1;
    if (::write(requests_[1], line.data(), line.size()) != static_cast<ssize_t>(line.size()) ||
        ::read(replies_[0], &status, sizeof status) != sizeof status)
      std::abort();
    return status;
  }

 private:
  int requests_[2], replies_[2];
  pid_t server_ = -1;

  // Until the tests have ended.
  [[noreturn]] void serve() {
    ::close(requests_[1]);
    ::close(replies_[0]);
    std::string folder;
    for (char c; ::read(requests_[0], &c, 1) == 1;) {
      if (c != '\n') {
        folder += c;
        continue;
      }
      int status = -1;
      const pid_t child = ::fork();
      if (child == 0) be_the_program(folder);
      ::waitpid(child, &status, 0);
      if (::write(replies_[1], &status, sizeof status) != sizeof status) break;
      folder.clear();
    }
    ::_exit(0);
  }

  [[noreturn]] void be_the_program(const std::filesystem::path& folder) {
    ::close(requests_[0]);
    ::close(replies_[1]);
    std::vector<std::string> arguments{"edgescout"};
    std::ifstream file(folder / "arguments");
    for (std::string argument; std::getline(file, argument, '\0');) arguments.push_back(argument);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    open_as("/dev/null", O_RDONLY, 0);
    open_as(folder / "out", O_WRONLY | O_CREAT, 1);
    open_as(folder / "err", O_WRONLY | O_CREAT, 2);
    const int exit_code = edgescout::run_program(static_cast<int>(arguments.size()), argv.data());
    std::cout.flush();
    std::fflush(nullptr);
    ::_exit(exit_code);
  }
  static void open_as(const std::filesystem::path& file, int how, int stream) {
    const int opened = ::open(file.c_str(), how, 0600);
    ::dup2(opened, stream);
    ::close(opened);
  }
};

ProgramForks* forks = nullptr;  // none under sanitizers: the file of the program is checked there

int status_in_shell(const std::vector<std::string>& arguments, const std::string& environment,
                    const std::filesystem::path& folder) {
  std::string command = environment + " '" EDGESCOUT_CLI "'";
  for (const std::string& argument : arguments) command += " '" + argument + "'";
  command +=
      " >'" + (folder / "out").string() + "' 2>'" + (folder / "err").string() + "' </dev/null";
  return std::system(command.c_str());
}

int status_of_fork(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
  std::ofstream file(folder / "arguments", std::ios::binary);
  for (const std::string& argument : arguments) file << argument << '\0';
  file.close();
  return forks->status_of(folder);
}

}  // namespace

Outcome run_program(const std::vector<std::string>& arguments, const std::string& environment) {
  const TemporaryFolder folder;
  const int status = forks && environment.empty()
                         ? status_of_fork(arguments, folder.path())
                         : status_in_shell(arguments, environment, folder.path());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(folder.path() / "out"),
          content_of(folder.path() / "err")};
}

}  // namespace edgescout::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  static const edgescout::test::TemporaryFolder caches;
  ::setenv("XDG_CACHE_HOME", caches.path().c_str(), 1);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  static edgescout::test::ProgramForks started;
  edgescout::test::forks = &started;
#endif
  return RUN_ALL_TESTS();
}
