// SPDX-License-Identifier: Apache-2.0
#include "gui/audit_texts.hpp"

#include <QFontMetrics>
#include <QPaintDevice>
#include <QPaintEngine>
#include <QWidget>
#include <cmath>

namespace cortex::test {

namespace {

// Paints nothing, and keeps the texts.
class TextEngine : public QPaintEngine {
public:
    TextEngine() : QPaintEngine{AllFeatures} {}

    std::vector<PaintedText> texts;

    void drawTextItem(const QPointF& at, const QTextItem& item) override {
        const QFontMetricsF metrics{item.font()};
        const QRectF box{at.x(), at.y() - metrics.ascent(), item.width(), metrics.height()};
        texts.push_back({item.text(), transform_.mapRect(box).toAlignedRect()});
    }
    void updateState(const QPaintEngineState& state) override { transform_ = state.transform(); }

    bool begin(QPaintDevice* /*device*/) override { return true; }
    bool end() override { return true; }
    void drawPixmap(const QRectF& /*to*/, const QPixmap& /*pixmap*/,
                    const QRectF& /*from*/) override {}
    void drawImage(const QRectF& /*to*/, const QImage& /*image*/, const QRectF& /*from*/,
                   Qt::ImageConversionFlags /*flags*/) override {}
    void drawPath(const QPainterPath& /*path*/) override {}
    void drawPolygon(const QPointF* /*points*/, int /*count*/, PolygonDrawMode /*mode*/) override {}
    Type type() const override { return User; }

private:
    QTransform transform_;
};

// As large and as fine as the window.
class TextDevice : public QPaintDevice {
public:
    explicit TextDevice(const QWidget& window) : window_{window} {}

    QPaintEngine* paintEngine() const override { return &engine_; }
    std::vector<PaintedText>& texts() { return engine_.texts; }

protected:
    int metric(PaintDeviceMetric which) const override {
        switch (which) {
            case PdmWidth:
                return window_.width();
            case PdmHeight:
                return window_.height();
            case PdmWidthMM:
                return window_.widthMM();
            case PdmHeightMM:
                return window_.heightMM();
            case PdmNumColors:
                return 0x7fffffff;
            case PdmDepth:
                return 32;
            case PdmDpiX:
            case PdmPhysicalDpiX:
                return window_.logicalDpiX();
            case PdmDpiY:
            case PdmPhysicalDpiY:
                return window_.logicalDpiY();
            case PdmDevicePixelRatio:
                return 1;
            case PdmDevicePixelRatioScaled:
                return static_cast<int>(devicePixelRatioFScale());
            default:
                return QPaintDevice::metric(which);
        }
    }

private:
    const QWidget& window_;
    mutable TextEngine engine_;
};

}  // namespace

std::vector<PaintedText> paintedTexts(QWidget& window) {
    TextDevice device{window};
    window.render(&device);
    return std::move(device.texts());
}

}  // namespace cortex::test
