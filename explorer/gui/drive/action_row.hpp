// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drive/axis_reasons.hpp"

#include <QWidget>
#include <array>

class QPushButton;

namespace cortex::explorer {

class Sentence;

// Enable, Disable, Quick stop, Reset fault: always in the same place, each with the reason below
// it why it cannot be pressed.
class ActionRow : public QWidget {
    Q_OBJECT
public:
    static constexpr std::size_t count = 4;

    explicit ActionRow(QWidget* parent = nullptr);

    void show(const AxisReasons& reasons);
    // Reasons that all have, or that are too long for their place, in sentences.
    QString longReasons() const { return long_; }
    QPushButton& button(const char* command) const;

Q_SIGNALS:
    void wanted(const QString& command, const QString& title);

protected:
    void changeEvent(QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    void fit();
    void place();

    std::array<QPushButton*, count> buttons_{};
    std::array<Sentence*, count> reasons_{};
    std::array<QString, count> why_;
    QString all_, long_;
    bool fitting_ = false;
};

}  // namespace cortex::explorer
