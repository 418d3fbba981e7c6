#include "app/signals.h"

#include <array>
#include <csignal>

namespace weft {

namespace {

constexpr std::array k_signals{SIGINT, SIGTERM};

volatile std::sig_atomic_t g_received = 0;

void note(int signal) {
    g_received = signal;
}

} // namespace

StopSignals::StopSignals() {
    g_received = 0;
    struct sigaction action {};
    action.sa_handler = note;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
    for (const int signal : k_signals) {
        ::sigaction(signal, &action, nullptr);
    }
}

StopSignals::~StopSignals() {
    for (const int signal : k_signals) {
        std::signal(signal, SIG_DFL);
    }
}

int StopSignals::received() {
    return g_received;
}

} // namespace weft
