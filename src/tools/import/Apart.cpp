// SPDX-License-Identifier: GPL-3.0-only
#include "tools/import/Apart.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

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

/// Without SA_RESTART, so that waiting for the other process ends.
void handleInterrupts(void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    for (const int signal : INTERRUPTS)
        sigaction(signal, &action, nullptr);
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

void limit(decltype(RLIMIT_AS) resource, std::uintmax_t soft) {
    rlimit limits{};
    getrlimit(resource, &limits);
    limits.rlim_cur = std::min<rlim_t>(soft, limits.rlim_max);
    setrlimit(resource, &limits);
}

void apply(const Limits& limits) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody would take the result
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, limits.processorSeconds);
    limit(RLIMIT_AS, addressSpace() + limits.memoryBytes);
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
[[noreturn]] void workAndExit(const std::string& name, const Limits& limits,
                              const std::function<std::string()>& work, int result) {
    handleInterrupts(SIG_DFL);
    apply(limits);
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

/// All that arrives until the other process ends.
std::string readAll(int descriptor, pid_t process) {
    std::string text;
    std::array<char, 4096> buffer;
    for (;;) {
        const ssize_t count = read(descriptor, buffer.data(), buffer.size());
        if (interruptedBy != 0)
            kill(process, SIGKILL);
        if (count > 0)
            text.append(buffer.data(), static_cast<std::size_t>(count));
        else if (count == 0 || errno != EINTR)
            return text;
    }
}

int waitFor(pid_t process) {
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

/// How a process died that a signal ended.
std::string causeOfDeath(int signal, const Limits& limits) {
    if (signal == SIGXCPU)
        return "took more than " + std::to_string(limits.processorSeconds) + " seconds";
    return "crashed its reader: signal " + std::to_string(signal) + ", " + strsignal(signal);
}

}  // namespace

std::string runApart(const std::string& name, const Limits& limits,
                     const std::function<std::string()>& work) {
    std::array<int, 2> ends{};  // of the pipe: to read, to write
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        failWithErrno("no pipe");
    handleInterrupts(noteInterrupt);
    const pid_t process = fork();
    if (process < 0)
        failWithErrno("no process");
    if (process == 0)
        workAndExit(name, limits, work, ends[1]);
    close(ends[1]);
    std::string text = readAll(ends[0], process);
    close(ends[0]);
    const int status = waitFor(process);
    if (interruptedBy != 0)
        throw std::runtime_error("interrupted");
    if (WIFSIGNALED(status))
        throw std::runtime_error(name + ": " + causeOfDeath(WTERMSIG(status), limits));
    if (WEXITSTATUS(status) != EXIT_SUCCESS)
        throw std::runtime_error(text.empty() ? name + ": ended its reader" : text);
    return text;
}

}  // namespace bwfirt
