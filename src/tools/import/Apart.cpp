// SPDX-License-Identifier: GPL-3.0-only
#include "tools/import/Apart.h"

#include "scene/FileIO.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace bwfirt {

namespace {

constexpr std::array INTERRUPTS = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t interruptedBy = 0;

void noteInterrupt(int signal) {
    interruptedBy = signal;
}

sigset_t interrupts() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : INTERRUPTS)
        sigaddset(&set, signal);
    return set;
}

/// But not where the user ignores them, as nohup does.
void handleInterrupts(void (*handler)(int)) {
    for (const int signal : INTERRUPTS) {
        struct sigaction action {};
        sigaction(signal, nullptr, &action);
        if (action.sa_handler == SIG_IGN)
            continue;
        action.sa_handler = handler;
        sigaction(signal, &action, nullptr);
    }
}

void setBlocked(int how) {
    const sigset_t set = interrupts();
    sigprocmask(how, &set, nullptr);
}

[[noreturn]] void failWithErrno(const std::string& what) {
    throw std::runtime_error(what + ": " + std::generic_category().message(errno));
}

/// The address space that the process has already, in bytes.
std::uintmax_t addressSpace() {
    std::uintmax_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<std::uintmax_t>(sysconf(_SC_PAGESIZE));
}

void limit(decltype(RLIMIT_AS) resource, rlim_t soft) {
    rlimit limits{};
    getrlimit(resource, &limits);
    limits.rlim_cur = std::min(soft, limits.rlim_max);
    setrlimit(resource, &limits);
}

/// What keeps harm that the work does inside its process.
void shield(std::uintmax_t memory) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // without its parent nobody would take the result
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_AS, addressSpace() + memory);
    const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
}

void writeAll(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = write(descriptor, text.data(), text.size());
        if (written < 0)
            return;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
}

/// The life of the other process. It never returns to main, whose work is not its own.
[[noreturn]] void workAndExit(const std::string& name, const std::function<std::string()>& work,
                              int result) {
    handleInterrupts(SIG_DFL);
    setBlocked(SIG_UNBLOCK);
    shield(availableMemory());
    int status = EXIT_FAILURE;
    try {
        writeAll(result, work());
        status = EXIT_SUCCESS;
    } catch (const std::bad_alloc&) {
        writeAll(result, name + ": not enough memory");
    } catch (const std::exception& error) {
        writeAll(result, error.what());
    }
    _exit(status);
}

/// All that arrives until the other process ends. Interrupts come through only while this waits, so
/// that none is missed.
std::string readAll(int descriptor, pid_t process) {
    std::string text;
    std::array<char, 4096> buffer;
    sigset_t none;
    sigemptyset(&none);
    for (;;) {
        pollfd poll{descriptor, POLLIN, 0};
        if (ppoll(&poll, 1, nullptr, &none) < 0) {
            if (interruptedBy != 0)
                kill(process, SIGKILL);
            continue;
        }
        const ssize_t count = read(descriptor, buffer.data(), buffer.size());
        if (count <= 0)
            return text;
        text.append(buffer.data(), static_cast<std::size_t>(count));
    }
}

int waitFor(pid_t process) {
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

/// How a process died that a signal ended.
std::string causeOfDeath(int signal) {
    if (signal == SIGXCPU)
        return "keeps its reader busy for too long";
    return "crashes its reader: signal " + std::to_string(signal) + ", " + strsignal(signal);
}

}  // namespace

void holdInterrupts() {
    handleInterrupts(noteInterrupt);
    setBlocked(SIG_BLOCK);
}

std::string runApart(const std::string& name, const std::function<std::string()>& work) {
    std::array<int, 2> ends{};  // of the pipe: to read, to write
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        failWithErrno("no pipe");
    const pid_t process = fork();
    if (process < 0)
        failWithErrno("no process");
    if (process == 0)
        workAndExit(name, work, ends[1]);
    close(ends[1]);
    std::string text = readAll(ends[0], process);
    close(ends[0]);
    const int status = waitFor(process);
    if (interruptedBy != 0)
        throw std::runtime_error("interrupted");
    if (WIFSIGNALED(status))
        throw std::runtime_error(name + ": " + causeOfDeath(WTERMSIG(status)));
    if (WEXITSTATUS(status) != EXIT_SUCCESS)
        throw std::runtime_error(text.empty() ? name + ": ends its reader" : text);
    return text;
}

void limitProcessorTime(std::uint64_t seconds) {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    limit(RLIMIT_CPU, static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + seconds);
}

void liftProcessorTimeLimit() {
    limit(RLIMIT_CPU, RLIM_INFINITY);
}

}  // namespace bwfirt
