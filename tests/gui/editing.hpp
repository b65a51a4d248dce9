// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/window_fixture.hpp"
#include "views/edit_bar.hpp"
#include "widgets/text_label.hpp"
#include "window/control_bar.hpp"

#include <QKeyEvent>
#include <QLineEdit>
#include <QPushButton>
#include <algorithm>
#include <stdexcept>
#include <string>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {

// Items of /drive that are set in the table of data, with a real agent over DDS.
class Editing : public Window {
protected:
    using Window::Window;

    bool isReady() {
        if (!everythingComes()) return false;
        window.open("/drive");
        window.openPart("data");
        return comes([this] { return valueOf("dampingRatio") != "…"; });
    }
    bool takes(const std::string& prefix) {
        session.takeControl(prefix);
        return comes([&] { return window.control().prefix() == prefix; });
    }
    ItemTable& table() { return *window.current()->findChild<ItemTable*>(); }
    EditBar& bar() { return *window.current()->findChild<EditBar*>(); }
    QModelIndex cellOf(const QString& item) {
        const auto& rows = *table().model();
        for (int group = 0; group < rows.rowCount(); ++group) {
            const QModelIndex above = rows.index(group, 0);
            for (int row = 0; row < rows.rowCount(above); ++row) {
                if (rows.index(row, ItemModel::Name, above).data() == item) {
                    return rows.index(row, ItemModel::Value, above);
                }
            }
        }
        return {};
    }
    // The field that is open; null: none.
    QLineEdit* field() {
        const auto fields = table().findChildren<QLineEdit*>();
        const auto found =
            std::ranges::find_if(fields, [&](const auto* each) { return !each->isHidden(); });
        return found == fields.end() ? nullptr : *found;
    }
    // F2, the text, and the key that ends it.
    void type(const QModelIndex& cell, const QString& item, const QString& text, Qt::Key key) {
        table().setCurrentIndex(cell);
        QKeyEvent edit{QEvent::KeyPress, Qt::Key_F2, Qt::NoModifier};
        QApplication::sendEvent(&table(), &edit);
        ASSERT_NE(field(), nullptr) << item.toStdString();
        EXPECT_TRUE(field()->accessibleName().startsWith(item));
        field()->setText(text);
        QTest::keyClick(field(), key);
        QApplication::processEvents();
    }
    void enters(const QString& item, const QString& text, Qt::Key key) {
        type(cellOf(item), item, text, key);
    }
    bool says(const QString& text) {
        return comes([&] { return bar().findChild<TextLabel*>()->text().contains(text); });
    }
    QPushButton& button(const QString& text) {
        for (auto* each : bar().findChildren<QPushButton*>()) {
            if (each->text().startsWith(text)) return *each;
        }
        throw std::runtime_error{"no such button"};
    }
};

}  // namespace cortex::test
