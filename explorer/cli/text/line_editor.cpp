// SPDX-License-Identifier: Apache-2.0
#include "text/line_editor.hpp"

#include "cortex/core/cell.hpp"

#include "text/interrupts.hpp"
#include "text/plain_text.hpp"
#include "text/words.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <clocale>
#include <cstdio>
#include <cwchar>
#include <utility>

#include <histedit.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace cortex::cli {
namespace {

constexpr char endOfInput = '\x04';  // Ctrl-D
constexpr int keptLines = 1000;
constexpr std::size_t shownCandidates = 200;
constexpr const char* nothingFollows = "/.=";  // a word that ends so goes on

std::string commonStart(const std::vector<std::string>& words) {
    std::string start = words.front();
    for (const std::string& each : words) {
        const auto end = std::ranges::mismatch(start, each).in1;
        start.erase(end, start.end());
    }
    start.resize(fittingLength(words.front(), start.size()));
    return start;
}

void printInColumns(const std::vector<std::string>& words) {
    winsize size{};
    const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    std::size_t width = 0;
    for (const std::string& each : words) width = std::max(width, textWidth(each) + 2);
    const std::size_t columns = std::max<std::size_t>((known ? size.ws_col : 80) / width, 1);
    std::string text = "\n";
    for (std::size_t i = 0; i < std::min(words.size(), shownCandidates); ++i) {
        const bool last = (i + 1) % columns == 0 || i + 1 == words.size();
        text += printable(words[i]);
        text += last ? "\n" : std::string(width - textWidth(words[i]), ' ');
    }
    if (words.size() > shownCandidates) {
        text += "\nand " + std::to_string(words.size() - shownCandidates) + " more\n";
    }
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
}

}  // namespace

struct LineEditor::Implementation {
    Implementation(Hooks given, std::string file)
        : hooks{std::move(given)}, historyFile{std::move(file)} {
        std::setlocale(LC_CTYPE, "");  // only what a character is; numbers stay as they are
        past = history_init();
        HistEvent event{};
        history(past, &event, H_SETSIZE, keptLines);
        history(past, &event, H_SETUNIQUE, 1);
        if (!historyFile.empty()) history(past, &event, H_LOAD, historyFile.c_str());
        editor = el_init("cortex", stdin, stdout, stderr);
        el_set(editor, EL_CLIENTDATA, this);
        el_set(editor, EL_PROMPT, &promptOf);
        el_set(editor, EL_EDITOR, "emacs");
        el_set(editor, EL_SIGNAL, 0);
        el_set(editor, EL_HIST, history, past);
        el_set(editor, EL_GETCFN, &nextCharacter);
        // The wide form keeps these texts as they are; the other makes copies that it never frees.
        el_wset(editor, EL_ADDFN, L"cortex-complete", L"Completes the word", &complete);
        el_set(editor, EL_BIND, "^I", "cortex-complete", nullptr);
        el_set(editor, EL_BIND, "^R", "em-inc-search-prev", nullptr);
    }
    ~Implementation() {
        HistEvent event{};
        if (!historyFile.empty()) history(past, &event, H_SAVE, historyFile.c_str());
        el_end(editor);
        history_end(past);
    }
    Implementation(const Implementation&) = delete;
    Implementation& operator=(const Implementation&) = delete;

    static Implementation& of(EditLine* editor) {
        void* self = nullptr;
        el_get(editor, EL_CLIENTDATA, &self);
        return *static_cast<Implementation*>(self);
    }
    static char* promptOf(EditLine* editor) {
        Implementation& self = of(editor);
        self.prompt = self.hooks.prompt();
        return self.prompt.data();
    }

    // Above the line, which is drawn again.
    void show(const std::string& news) const {
        if (news.empty()) return;
        std::fputs(("\r\033[K" + news + "\n").c_str(), stdout);
        std::fflush(stdout);
        el_set(editor, EL_REFRESH);
    }

    static bool lineIsEmpty(EditLine* editor) {
        const LineInfo* line = el_line(editor);
        return line->lastchar == line->buffer;
    }

    // Ctrl-D in an empty line ends it here: libedit was seen to take it for a character under load.
    static int nextCharacter(EditLine* editor, wchar_t* character) {
        const Implementation& self = of(editor);
        std::mbstate_t state{};
        for (;;) {
            pollfd keys{STDIN_FILENO, POLLIN, 0};
            const int ready = poll(&keys, 1, static_cast<int>(interruptSlice.count()));
            if (Interrupts::signal() != 0) return -1;
            self.show(self.hooks.news());
            if (ready <= 0) continue;
            char octet = 0;
            const ssize_t count = ::read(STDIN_FILENO, &octet, 1);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) return 0;
            if (octet == endOfInput && lineIsEmpty(editor)) return 0;
            const std::size_t used = std::mbrtowc(character, &octet, 1, &state);
            if (used == static_cast<std::size_t>(-1)) state = {};  // no character: it is left out
            if (used <= 1) return 1;
        }
    }

    static unsigned char complete(EditLine* editor, int) {
        const LineInfo* line = el_line(editor);
        const std::string before{line->buffer, line->cursor};
        const std::string word = before.substr(lastWord(before));
        std::vector<std::string> fitting = of(editor).hooks.complete(before);
        std::erase_if(fitting, [&](const std::string& each) { return !each.starts_with(word); });
        std::ranges::sort(fitting);
        const auto [first, last] = std::ranges::unique(fitting);
        fitting.erase(first, last);
        if (fitting.empty()) return CC_REFRESH_BEEP;
        std::string more = commonStart(fitting).substr(word.size());
        const bool done =
            fitting.size() == 1 && !fitting.front().empty() &&
            std::string{nothingFollows}.find(fitting.front().back()) == std::string::npos;
        if (done) more += ' ';
        if (more.empty()) {
            printInColumns(fitting);
            return CC_REDISPLAY;
        }
        return el_insertstr(editor, more.c_str()) == 0 ? CC_REFRESH : CC_ERROR;
    }

    Hooks hooks;
    std::string historyFile, prompt;
    EditLine* editor = nullptr;
    History* past = nullptr;
};

LineEditor::LineEditor(Hooks hooks, std::string historyFile)
    : implementation_{std::make_unique<Implementation>(std::move(hooks), std::move(historyFile))} {}

LineEditor::~LineEditor() = default;

LineEditor::Ended LineEditor::read(std::string& line) {
    Implementation& self = *implementation_;
    el_resize(self.editor);
    int count = 0;
    const char* typed = el_gets(self.editor, &count);
    if (Interrupts::signal() != 0) {
        std::fputs("\n", stdout);
        std::fflush(stdout);
        return Ended::ByInterrupt;
    }
    if (typed == nullptr || count <= 0) return Ended::ByEnd;
    line.assign(typed, static_cast<std::size_t>(count));
    while (!line.empty() && line.back() == '\n') line.pop_back();
    HistEvent event{};
    const bool blank = line.find_first_not_of(" \t") == std::string::npos;
    if (!blank) history(self.past, &event, H_ENTER, line.c_str());
    return Ended::ByReturn;
}

}  // namespace cortex::cli
