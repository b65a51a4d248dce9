// SPDX-License-Identifier: Apache-2.0
// The window while the thread of its session is stopped: it paints, answers, and says how old all
// is.
#include "gui/window_fixture.hpp"
#include "views/simplex_header.hpp"
#include "widgets/text_label.hpp"

#include <QLineEdit>
#include <QTabBar>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <future>
#include <set>

#include <sys/syscall.h>
#include <unistd.h>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace std::chrono_literals;

constexpr qint64 blockedFor = 5'000;  // ms

std::set<pid_t> threads() {
    std::set<pid_t> all;
    for (const auto& each : std::filesystem::directory_iterator{"/proc/self/task"}) {
        all.insert(std::stoi(each.path().filename()));
    }
    return all;
}

// The thread waits for something, with no lock of its own unless it waits for a second one.
bool waits(pid_t thread) {
    std::ifstream call{"/proc/self/task/" + std::to_string(thread) + "/syscall"};
    std::string number;
    call >> number;
    return number == std::to_string(SYS_futex);
}

int entered[2], release[2];  // pipes, as a handler of signals may use them

void holdUp(int /*signal*/) {
    const int error = errno;
    char octet = 0;
    (void)!write(entered[1], &octet, 1);
    (void)!read(release[0], &octet, 1);
    errno = error;
}

struct ThreadsBefore {
    const std::set<pid_t> threadsBefore = threads();
};

class BlockedSession : private ThreadsBefore, public Window {
protected:
    BlockedSession() {
        // Of the new threads the first one is that of the session: it starts all others.
        for (const pid_t each : threads()) {
            if (!threadsBefore.contains(each)) {
                thread_ = each;
                break;
            }
        }
        EXPECT_EQ(pipe(entered), 0);
        EXPECT_EQ(pipe(release), 0);
        struct sigaction action{};
        action.sa_handler = holdUp;
        action.sa_flags = SA_RESTART;
        sigaction(SIGUSR1, &action, &old_);
    }
    ~BlockedSession() override {
        if (held_) letGo();
        sigaction(SIGUSR1, &old_, nullptr);
        for (const int each : {entered[0], entered[1], release[0], release[1]}) close(each);
    }

    // Until it is let go. Not while it holds the lock that the window takes for a moment.
    void hold() {
        for (held_ = false; !held_;) {
            ASSERT_TRUE(comes([this] { return waits(thread_); }));
            ASSERT_EQ(syscall(SYS_tgkill, getpid(), thread_, SIGUSR1), 0);
            char octet = 0;
            ASSERT_EQ(read(entered[0], &octet, 1), 1);
            auto frame = std::async(std::launch::async, [this] { (void)session.frame(); });
            held_ = frame.wait_for(1s) == std::future_status::ready;
            if (!held_) letGo();
        }
    }
    void letGo() {
        const char octet = 0;
        ASSERT_EQ(write(release[1], &octet, 1), 1);
        held_ = false;
    }

    QString age() {
        for (const auto* each :
             window.current()->findChild<SimplexHeader*>()->findChildren<TextLabel*>()) {
            if (each->isVisible() && each->text().endsWith(" old")) return each->text();
        }
        return {};
    }
    // Shown, and painted.
    bool growsOlder() {
        const QString first = age();
        auto* header = window.current()->findChild<SimplexHeader*>();
        const QImage before = header->grab().toImage();
        return comes([&] { return age() != first; }) && header->grab().toImage() != before;
    }

    QElapsedTimer timer_;

private:
    pid_t thread_ = 0;
    bool held_ = false;
    struct sigaction old_{};
};

TEST_F(BlockedSession, LeavesAWindowThatPaintsAnswersAndSaysHowOldItsValuesAre) {
    ASSERT_TRUE(everythingComes());
    window.open("/mixer");
    ASSERT_TRUE(comes([this] { return age().endsWith(" old"); }));
    // Values come all the time before.
    for (int i = 0; i < 5; ++i) {
        const QString shown = valueOf("cycleDurationLast");
        ASSERT_TRUE(comes([&] { return valueOf("cycleDurationLast") != shown; }));
    }
    ASSERT_NO_FATAL_FAILURE(hold());
    timer_.start();
    window.refresh();
    const std::uint64_t number = session.frame()->number;

    QApplication::setActiveWindow(&window);
    QTest::keyClick(&window, Qt::Key_F, Qt::ControlModifier);
    QWidget* field = QApplication::focusWidget();
    ASSERT_NE(qobject_cast<QLineEdit*>(field), nullptr);
    QTest::keyClicks(field, "drive");
    EXPECT_EQ(qobject_cast<QLineEdit*>(field)->text(), "drive");
    EXPECT_TRUE(tree().indexOf("/drive").isValid());
    EXPECT_FALSE(tree().indexOf("/controller").isValid()) << "the tree is filtered";
    const QImage simplex = window.grab().toImage();
    QWidget* first = window.current();
    window.openKind("system");
    EXPECT_NE(window.current(), first);
    EXPECT_NE(window.grab().toImage(), simplex);
    window.open("/mixer");
    EXPECT_EQ(window.current(), first);
    while (timer_.elapsed() < blockedFor - 1'500) {
        ASSERT_TRUE(growsOlder()) << "it is " << age().toStdString() << " all the time";
    }
    comes([this] { return timer_.elapsed() >= blockedFor; });
    EXPECT_EQ(session.frame()->number, number) << "the session stood still all the time";
    EXPECT_TRUE(age().contains(" s old")) << age().toStdString();

    letGo();
    EXPECT_TRUE(comes([this] { return age().endsWith(" ms old"); })) << age().toStdString();
    EXPECT_TRUE(comes([&] { return session.frame()->number > number + 2; }));
    window.tree().filter({});
    EXPECT_TRUE(tree().indexOf("/controller").isValid());
    const std::int64_t cycle = session.frame()->agents.front().status.cycle;
    EXPECT_TRUE(comes([&] {
        const auto frame = session.frame();
        return frame->agents.front().status.cycle > cycle && !frame->agents.front().lost();
    })) << "it goes on";
}

}  // namespace
}  // namespace cortex::test
