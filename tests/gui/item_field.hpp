// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/made_agent.hpp"
#include "model/item_model.hpp"
#include "widgets/item_table.hpp"

#include <QApplication>
#include <QKeyEvent>
#include <QLineEdit>
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {

using namespace gui;

// The field of an item of /worker in the table of data.
class ItemField : public testing::Test {
protected:
    ItemField() {
        starts();
        items.show("/worker");
        shows({agent->now()});
        table.show();
    }
    void starts() {
        agent.emplace(
            "robot", [](SimplexTree& tree) { tree.add("/worker", "Worker"); }, "command-types.xml");
    }
    void shows(std::vector<AgentFrame> agents) { items.update(frameOf(std::move(agents))); }
    // Somebody else sets it.
    void comes(double gain) {
        agent->put("/worker", "gain", gain);
        shows({agent->now()});
    }
    QModelIndex cellOf(const QString& item) {
        for (int group = 0; group < items.rowCount(); ++group) {
            const QModelIndex above = items.index(group, 0);
            for (int row = 0; row < items.rowCount(above); ++row) {
                if (items.index(row, ItemModel::Name, above).data() == item)
                    return items.index(row, ItemModel::Value, above);
            }
        }
        return {};
    }
    // The field that is open; null: none.
    QLineEdit* field() {
        const auto fields = table.viewport()->findChildren<QLineEdit*>();
        const auto found =
            std::ranges::find_if(fields, [](const auto* each) { return !each->isHidden(); });
        return found == fields.end() ? nullptr : *found;
    }
    bool opens(const QModelIndex& cell) {
        table.setCurrentIndex(cell);
        QKeyEvent edit{QEvent::KeyPress, Qt::Key_F2, Qt::NoModifier};
        QApplication::sendEvent(&table, &edit);
        return field() != nullptr;
    }
    bool opens() { return opens(cellOf("gain")); }
    void press(Qt::Key key) {
        QTest::keyClick(field(), key);
        QApplication::processEvents();
    }
    // What was entered for an item and is not sent yet.
    std::optional<Value> entered(const std::string& item = "gain") {
        const auto edits = items.edits();
        const auto found = edits.find(item);
        return found != edits.end() ? std::optional{found->second} : std::nullopt;
    }
    static Value one(double value) { return std::vector{value}; }

    std::optional<MadeAgent> agent;
    ItemModel items;
    ItemTable table{items};
};

}  // namespace cortex::test
