// SPDX-License-Identifier: Apache-2.0
#include "patient_output.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <climits>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

namespace cortex::toolkit {
namespace {

constexpr std::chrono::milliseconds patience{200};
constexpr std::size_t most = 1 << 16;  // that is kept until a flush

// The same pipe or terminal, of which no write waits. Others have the file as well, so its own
// flags stay. Where it cannot be opened again, who writes asks first whether there is room.
int quickOf(int file) {
    struct stat status{};
    if (fstat(file, &status) != 0 || !(S_ISFIFO(status.st_mode) || isatty(file) != 0)) return file;
    const std::string path = "/proc/self/fd/" + std::to_string(file);
    const int quick = open(path.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    return quick >= 0 ? quick : file;
}

}  // namespace

PatientOutput::PatientOutput(std::ostream& stream, int file)
    : stream_{stream}, before_{stream.rdbuf()}, file_{file}, quick_{quickOf(file)} {
    stream.flush();
    stream.rdbuf(this);
}

PatientOutput::~PatientOutput() {
    stream_.flush();
    stream_.rdbuf(before_);
    if (quick_ != file_) close(quick_);
}

int PatientOutput::sync() {
    const std::lock_guard lock{mutex_};
    send();
    return 0;
}

PatientOutput::int_type PatientOutput::overflow(int_type character) {
    if (traits_type::eq_int_type(character, traits_type::eof())) return 0;
    const char one = traits_type::to_char_type(character);
    xsputn(&one, 1);
    return character;
}

std::streamsize PatientOutput::xsputn(const char* text, std::streamsize size) {
    const std::lock_guard lock{mutex_};
    kept_.append(text, static_cast<std::size_t>(size));
    if (kept_.size() >= most) send();
    return size;
}

void PatientOutput::send() {
    const auto lines = static_cast<std::size_t>(std::ranges::count(kept_, '\n'));
    if (missing_ > 0 && write("\n(lines missing here: " + std::to_string(missing_) + ")\n")) {
        missing_ = 0;
    }
    if (!write(kept_)) missing_ += std::max<std::size_t>(lines, 1);
    kept_.clear();
}

bool PatientOutput::write(std::string_view text) {
    const auto now = [] { return std::chrono::steady_clock::now(); };
    const auto end = now() + (isStuck_ ? std::chrono::milliseconds{0} : patience);
    while (!text.empty()) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(end - now()).count();
        pollfd ready{quick_, POLLOUT, 0};
        isStuck_ = poll(&ready, 1, static_cast<int>(std::max<std::int64_t>(left, 0))) == 0;
        if (isStuck_) return false;
        const ssize_t size =
            ::write(quick_, text.data(), std::min<std::size_t>(text.size(), PIPE_BUF));
        if (size > 0) text.remove_prefix(static_cast<std::size_t>(size));
        if (size < 0 && errno != EINTR && errno != EAGAIN) return false;  // nobody can read it
    }
    return true;
}

}  // namespace cortex::toolkit
