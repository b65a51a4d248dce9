// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/live_agent.hpp"
#include "model/item_model.hpp"
#include "model/system_model.hpp"
#include "support/patience.hpp"
#include "views/system_tree.hpp"
#include "widgets/item_table.hpp"
#include "window/main_window.hpp"

#include <QAbstractItemModelTester>
#include <QApplication>
#include <QElapsedTimer>
#include <QTimer>
#include <chrono>
#include <functional>
#include <string>

namespace cortex::test {

using namespace gui;

inline constexpr qint64 longEnough = std::chrono::milliseconds{patience}.count();

inline comms::NetworkOptions ownNetwork() {
    comms::NetworkOptions options;
    options.domain = std::stoi(domain);
    options.interfaces = {"127.0.0.1"};
    return options;
}

inline bool comes(const std::function<bool()>& condition) {
    QElapsedTimer timer;
    timer.start();
    QTimer events;  // it ends also where nothing else is an event
    events.start(100);
    while (!condition()) {
        if (timer.elapsed() > longEnough) return false;
        QApplication::processEvents(QEventLoop::WaitForMoreEvents);
    }
    return true;
}

// The same while the window handles no event at all.
inline bool comesWithoutEvents(const std::function<bool()>& condition) {
    QElapsedTimer timer;
    timer.start();
    while (!condition()) {
        if (timer.elapsed() > longEnough) return false;
    }
    return true;
}

// The system of `cortex new-system` in a window.
class Window : public CortexLive {
protected:
    explicit Window(const std::string& controller = "HoldAxisController")
        : CortexLive{controller},
          session{ownNetwork()},
          window{session},
          tester{const_cast<SystemModel*>(&window.tree().model()),
                 QAbstractItemModelTester::FailureReportingMode::Fatal} {
        window.show();
    }

    bool everythingComes() {
        const bool ready = comes([this] { return window.ready(); });
        window.refresh();  // what has come is shown, too
        return ready;
    }
    const SystemModel& tree() { return window.tree().model(); }
    // What the table of data shows of an item.
    QString valueOf(const QString& item) {
        const auto& rows = *window.current()->findChild<ItemTable*>()->model();
        for (int group = 0; group < rows.rowCount(); ++group) {
            const QModelIndex above = rows.index(group, 0);
            for (int row = 0; row < rows.rowCount(above); ++row) {
                if (rows.index(row, ItemModel::Name, above).data() == item) {
                    return rows.index(row, ItemModel::Value, above).data().toString();
                }
            }
        }
        return QStringLiteral("no such row");
    }
    QString wordOf(const std::string& path) {
        return tree().indexOf(path).data(Qt::AccessibleTextRole).toString();
    }
    std::string anActiveSimplex() {
        const auto frame = session.frame();
        for (const AgentFrame& each : frame->agents) {
            for (std::uint32_t i = 0; i < each.structure->simplexes.size(); ++i) {
                const Type& type = *each.structure->simplexes[i].layout->type;
                if (type.active() && !type.isA("Agent")) return each.structure->simplexes[i].path;
            }
        }
        return {};
    }

    Session session;
    MainWindow window;
    QAbstractItemModelTester tester;
};

}  // namespace cortex::test
