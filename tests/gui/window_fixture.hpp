// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/live_agent.hpp"
#include "gui/waiting.hpp"
#include "model/item_model.hpp"
#include "model/system_model.hpp"
#include "views/system_tree.hpp"
#include "widgets/item_table.hpp"
#include "window/main_window.hpp"

#include <QAbstractItemModelTester>
#include <chrono>
#include <future>
#include <string>
#include <vector>

namespace cortex::test {

using namespace gui;

inline comms::NetworkOptions ownNetwork() {
    comms::NetworkOptions options;
    options.domain = std::stoi(domain);
    options.interfaces = {"127.0.0.1"};
    return options;
}

// The system of `cortex new-system` in a window.
class Window : public CortexLive {
protected:
    explicit Window(const std::string& controller = "HoldAxisController",
                    const std::string& items = "")
        : CortexLive{controller, items},
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
    // A tool runs while the window goes on: one that stands still loses its control.
    static Outcome live(const std::vector<std::string>& arguments) {
        auto outcome = std::async(std::launch::async, [&] { return test::live(arguments); });
        const auto now = std::chrono::seconds{0};
        comes([&] { return outcome.wait_for(now) == std::future_status::ready; });
        return outcome.get();
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
