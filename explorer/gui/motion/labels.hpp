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

protected:
    void changeEvent(QEvent* event) override;

private:
    void dress();

    std::optional<Tone> tone_;
    bool dressing_ = false;
};

// Lines on a plate in the colour of what the operator holds; without text it is gone.
class Plate : public QLabel {
    Q_OBJECT
public:
    explicit Plate(QWidget* parent = nullptr);

    void say(const QString& text);
    void keepPlace(bool keeps);  // of one line, also where it is gone

protected:
    void paintEvent(QPaintEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void fit();
};

}  // namespace cortex::explorer
