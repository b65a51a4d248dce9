// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QAbstractButton>
#include <QAbstractSlider>
#include <QApplication>
#include <QComboBox>
#include <QLineEdit>
#include <map>
#include <string>

namespace cortex::test {

// Where everything stands in its window that can be pressed, drawn or typed into.
using Places = std::map<QWidget*, QRect>;

inline Places placesIn(QWidget& page) {
    for (int i = 0; i < 3; ++i) QApplication::processEvents();  // what is laid out lays out more
    Places all;
    for (auto* each : page.findChildren<QWidget*>()) {
        const bool counts = qobject_cast<QAbstractButton*>(each) != nullptr ||
                            qobject_cast<QAbstractSlider*>(each) != nullptr ||
                            qobject_cast<QComboBox*>(each) != nullptr ||
                            qobject_cast<QLineEdit*>(each) != nullptr ||
                            each->inherits("cortex::explorer::AxisRow");
        if (counts && each->isVisible() && each->window() == page.window())
            all[each] = {each->mapTo(each->window(), QPoint{}), each->size()};
    }
    return all;
}

inline std::string nameOf(const QWidget& widget) {
    const auto* button = qobject_cast<const QAbstractButton*>(&widget);
    const QString text = button != nullptr ? button->text() : QString{};
    return (text + " (" + widget.accessibleName() + ", " + widget.metaObject()->className() + ")")
        .toStdString();
}

// What stands elsewhere by now, or came where another one was; a line each.
inline std::string movedSince(const Places& before, QWidget& page) {
    std::string moved;
    for (const auto& [widget, place] : placesIn(page)) {
        const auto found = before.find(widget);
        if (found != before.end()) {
            if (found->second == place) continue;
            const QRect& was = found->second;
            moved += nameOf(*widget) + " moved by " + std::to_string(place.x() - was.x()) + ", " +
                     std::to_string(place.y() - was.y()) + ", resized by " +
                     std::to_string(place.width() - was.width()) + ", " +
                     std::to_string(place.height() - was.height()) + '\n';
            continue;
        }
        for (const auto& [other, itsPlace] : before) {
            if (qobject_cast<QAbstractButton*>(other) != nullptr && itsPlace.intersects(place))
                moved += nameOf(*widget) + " came where another button was\n";
        }
    }
    return moved;
}

}  // namespace cortex::test
