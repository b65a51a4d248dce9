// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/explorer/theme.hpp"

#include <QLabel>
#include <optional>

namespace cortex::explorer {

// A sentence in one of the tones of the theme, in as many lines as it takes.
class Sentence : public QLabel {
    Q_OBJECT
public:
    explicit Sentence(std::optional<Tone> tone = {}, QWidget* parent = nullptr);

    void say(const QString& text);
    void say(const QString& text, std::optional<Tone> tone);
    // Takes just so many lines, whatever it says: nothing beside it moves with another text. What
    // has no room ends with "…", and is whole in the tooltip.
    void keepLines(int count);

protected:
    void paintEvent(QPaintEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void dress();
    void fit();

    std::optional<Tone> tone_;
    int lines_ = 0;  // 0: as many as it takes
    bool dressing_ = false;
};

// Lines on a plate in the colour of what the operator holds. It keeps its place, also without text,
// where there is nothing to see; what has no room ends with "…", and is whole in the tooltip.
class Plate : public QLabel {
    Q_OBJECT
public:
    explicit Plate(QWidget* parent = nullptr);

    void say(const QString& text);
    void keepLines(int count);

protected:
    void paintEvent(QPaintEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void fit();

    int lines_ = 1;
};

}  // namespace cortex::explorer
