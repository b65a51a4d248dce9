// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "style/shapes.hpp"

#include <QAbstractButton>
#include <optional>

namespace cortex::gui {

// A kind of rows with their number: on while they are shown. Off, its word is struck through and
// says so.
class Chip : public QAbstractButton {
    Q_OBJECT
public:
    explicit Chip(const QString& word, std::optional<Shape> mark = std::nullopt,
                  QWidget* parent = nullptr);

    void explain(const QString& meaning);  // in the tooltip
    // Of rows of its kind, shown or not. It has room for more digits than it shows; `grows`: it may
    // have more of it now.
    void show(std::uint64_t count, bool grows = true);
    QSize sizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void tell();
    QString rest(const QString& count) const;  // after the word

    QString word_, meaning_, count_, room_;  // room_: as wide as a count may be
    std::optional<Shape> mark_;
};

}  // namespace cortex::gui
