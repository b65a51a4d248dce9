// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drive/words.hpp"

#include <QWidget>
#include <array>
#include <optional>

class QPainter;

namespace cortex::explorer {

// A word as it came, with the names of its bits.
struct ShownWord {
    QString title;            // "status word"
    std::optional<int> word;  // none: it never came
    bool live = false;
    std::vector<NamedBit> bits{};

    bool operator==(const ShownWord&) const = default;
};

// Status word and control word side by side, bit by bit: a disc where it is set, a ring where it is
// not.
class WordTable : public QWidget {
    Q_OBJECT
public:
    explicit WordTable(QWidget* parent = nullptr);

    void show(const ShownWord& status, const ShownWord& control);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    QFont noteFont() const;
    int rowHeight() const;
    int columnWidth() const;
    void paintWord(QPainter& painter, const ShownWord& word, const QRect& box) const;
    void paintBit(QPainter& painter, const ShownWord& word, const NamedBit& bit,
                  const QRect& box) const;

    std::array<ShownWord, 2> words_;
};

}  // namespace cortex::explorer
