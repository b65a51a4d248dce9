// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>
#include <QWidget>
#include <memory>
#include <optional>

namespace cortex::explorer {

// The last seconds of a few lines, for views of one's own. A view feeds it once a refresh; what did
// not come is hatched, and no line goes across it. Its right edge is now.
class SmallPlot : public QWidget {
    Q_OBJECT
public:
    // "position", "rad" as SimplexNow::unit() typesets it.
    explicit SmallPlot(const QString& title, const QString& unit = {}, QWidget* parent = nullptr);
    ~SmallPlot() override;

    // Its number, from 0; the name stands beside the tag of the line. A demand is dashed in the
    // colour of the line before it.
    int addLine(const QString& name, bool demand = false);
    void setSpan(double seconds);  // 10 unless it is set
    void setLimits(std::optional<double> min, std::optional<double> max);

    // One moment of a line, in seconds by one clock for all lines, such as clock(). None: it is
    // not live, or it never came. A moment that is not later than the one before is left out.
    void put(int line, double seconds, std::optional<double> value);
    // To be called once a refresh, after put(): the right edge.
    void setNow(double seconds);
    // Seconds by the clock of this machine, which only grows; for put() and setNow().
    static double clock();

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    struct Content;
    void describe();

    std::unique_ptr<Content> content_;
};

}  // namespace cortex::explorer
