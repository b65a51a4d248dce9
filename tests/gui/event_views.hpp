// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/events_fixture.hpp"
#include "support/share.hpp"
#include "views/event_list.hpp"
#include "views/event_table.hpp"
#include "views/event_view.hpp"
#include "widgets/chip.hpp"
#include "widgets/text_label.hpp"

#include <QApplication>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QWheelEvent>
#include <algorithm>

#include <gtest/gtest.h>

namespace cortex::test {

using namespace gui;

inline bool says(const QWidget& widget, const QString& text) {
    const auto labels = widget.findChildren<TextLabel*>();
    return std::ranges::any_of(
        labels, [&](const auto* each) { return !each->isHidden() && each->text().contains(text); });
}

inline bool isAtTheEnd(const EventTable& rows) {
    QApplication::processEvents();
    return rows.verticalScrollBar()->value() == rows.verticalScrollBar()->maximum();
}

// The strip of events.
class Events : public testing::Test {
protected:
    Events() {
        list.resize(800, 200);
        list.show();
    }
    EventTable& rows() { return *list.findChild<EventTable*>(); }

    EventModel events{share(EventModel{}.kept())};
    EventFilter shown{events};
    EventList list{shown};
};

inline void scrollUp(EventTable& rows) {
    QWheelEvent notch{{10, 10},
                      rows.viewport()->mapToGlobal(QPoint{10, 10}),
                      {},
                      {0, 120},
                      Qt::NoButton,
                      Qt::NoModifier,
                      Qt::NoScrollPhase,
                      false};
    QApplication::sendEvent(rows.viewport(), &notch);
}

inline QPushButton* buttonIn(const QWidget& widget, const QString& text) {
    for (auto* each : widget.findChildren<QPushButton*>()) {
        if (each->text() == text && !each->isHidden()) return each;
    }
    return nullptr;
}

// And the tab, with the same filter.
class EventTab : public Events {
protected:
    EventTab() {
        view.resize(1000, 600);
        view.show();
        QApplication::processEvents();
    }
    EventTable& table() { return *view.findChild<EventTable*>(); }
    QPushButton* button(const QString& text) {
        for (auto* each : view.findChildren<QPushButton*>()) {
            if (each->text().contains(text) && !each->isHidden()) return each;
        }
        return nullptr;
    }
    Chip* chip(const QString& name) {
        for (auto* each : view.findChildren<Chip*>()) {
            if (each->accessibleName() == name && !each->isHidden()) return each;
        }
        return nullptr;
    }
    void type(const QString& text) {
        view.findChild<QLineEdit*>()->setText(text);
        view.refresh();
    }

    EventView view{shown, {}};
};

}  // namespace cortex::test
