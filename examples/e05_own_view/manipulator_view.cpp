// SPDX-License-Identifier: Apache-2.0
// A view of one's own for `cortex-explorer`: each axis of a manipulator as a dial, with where it is
// and where it is wished to be. It fits every type that extends Manipulator.
#include "cortex/explorer/view.hpp"

#include <QPainter>
#include <algorithm>
#include <cmath>

using namespace cortex::explorer;

struct Dial {
    QString name, text;
    std::optional<double> now, wished;
    double min, max;
    bool live;
};

class ManipulatorView final : public View {
public:
    explicit ManipulatorView(std::string path) : path_{std::move(path)} {}

    void refresh(const SystemNow& now) override {
        const SimplexNow arm = now.at(path_);
        const auto axes = arm.related("axes"), demands = arm.related("demands");
        dials_.clear();
        for (std::size_t i = 0; i < axes.size(); ++i) {
            const SimplexNow axis = now.at(axes[i]);
            dials_.push_back({QString::fromStdString(axes[i]).section('/', -1),
                              axis.text("position") + ' ' + axis.unit("position"),
                              axis.number("position"),
                              now.at(i < demands.size() ? demands[i] : "").number("position"),
                              axis.min("position").value_or(-M_PI),
                              axis.max("position").value_or(M_PI), axis.live()});
        }
        update();
    }

protected:
    void paintEvent(QPaintEvent*) override {
        QPainter painter{this};
        painter.setRenderHint(QPainter::Antialiasing);
        const int line = fontMetrics().height(), cell = 11 * line;
        const int columns = std::max(1, width() / cell);
        for (std::size_t i = 0; i < dials_.size(); ++i) {
            const Dial& dial = dials_[i];
            const QRect box{static_cast<int>(i) % columns * cell,
                            static_cast<int>(i) / columns * cell, cell, cell};
            const QRectF circle = box.adjusted(line, line, -2 * line, -2 * line);
            painter.setPen(QPen{palette().color(QPalette::Mid), 6});
            painter.drawArc(circle, -60 * 16, 300 * 16);
            if (dial.wished) drawHand(painter, circle, dial, *dial.wished, false);
            if (dial.now) drawHand(painter, circle, dial, *dial.now, dial.live);
            painter.setPen(palette().color(QPalette::WindowText));
            painter.drawText(box.adjusted(line, 0, 0, 0), dial.name);
            painter.drawText(box.adjusted(line, 0, -2 * line, -line),
                             Qt::AlignHCenter | Qt::AlignBottom, dial.text);
        }
    }

private:
    // What is wished, or not live, is dashed. The scale goes from lower left to lower right.
    void drawHand(QPainter& painter, QRectF circle, const Dial& dial, double value, bool solid) {
        const double share = std::clamp((value - dial.min) / (dial.max - dial.min), 0.0, 1.0);
        const double angle = (240 - 300 * share) * M_PI / 180;
        painter.setPen(QPen{palette().color(QPalette::WindowText), solid ? 4.0 : 2.0,
                            solid ? Qt::SolidLine : Qt::DashLine});
        const QPointF tip{std::cos(angle), -std::sin(angle)};
        painter.drawLine(circle.center(), circle.center() + tip * circle.width() / 2);
    }

    std::string path_;
    std::vector<Dial> dials_;
};

View* makeView(const std::string& path) { return new ManipulatorView{path}; }
CORTEX_EXPLORER_PLUGIN({"manipulator-dials", "Dials", "Manipulator", &makeView})
