// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drive/drive_axis.hpp"
#include "motion/shown_number.hpp"

#include <QWidget>
#include <array>

class QPainter;

namespace cortex::explorer {

// A number as it is shown: in the unit that the page has for it.
struct ShownDriveNumber {
    DriveNumber number{};
    ShownNumber shown{};
};

// Position, velocity and effort of an axis: as they are, and as they are wished; with a bar where
// there is room and a range.
class AxisNumbers : public QWidget {
    Q_OBJECT
public:
    explicit AxisNumbers(QWidget* parent = nullptr);

    // `live`: what is; `told`: what is wished.
    void show(const std::array<ShownDriveNumber, 3>& numbers, bool live, bool told);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    struct Columns {
        QRect name, bar, now, wished;
    };
    QFont noteFont() const;
    int rowHeight() const;
    int nameWidth() const;
    int numberWidth() const;
    Columns columns(int row) const;
    void paintBar(QPainter& painter, const ShownDriveNumber& number, const QRect& box) const;

    std::array<ShownDriveNumber, 3> numbers_;
    bool live_ = false, told_ = false;
};

}  // namespace cortex::explorer
