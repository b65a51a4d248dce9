// SPDX-License-Identifier: Apache-2.0
#include "gui/colour_vision.hpp"
#include "style/glyphs.hpp"
#include "style/look.hpp"
#include "style/plurals.hpp"
#include "style/shapes.hpp"
#include "style/tokens.hpp"

#include <QDirIterator>
#include <QFile>
#include <QImage>
#include <QRegularExpression>
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

constexpr std::array visions{Vision::Normal, Vision::Protanopia, Vision::Deuteranopia,
                             Vision::Tritanopia};

std::string nameOf(Theme theme) { return themeName(theme).toStdString(); }

QImage shapeImage(Shape shape, int pixels, Theme theme) {
    QImage image{pixels, pixels, QImage::Format_RGB32};
    image.fill(tokens(theme).surface);
    QPainter painter{&image};
    paint(painter, image.rect(), shape, tokens(theme));
    return image;
}

// The share of pixels that a grey print shows clearly different.
double greyDifference(const QImage& one, const QImage& other) {
    int different = 0;
    for (int y = 0; y < one.height(); ++y) {
        for (int x = 0; x < one.width(); ++x) {
            if (std::abs(qGray(one.pixel(x, y)) - qGray(other.pixel(x, y))) > 24) ++different;
        }
    }
    return static_cast<double>(different) / (one.width() * one.height());
}

TEST(Tokens, HaveTheContrastThatTextAndGraphicsNeed) {
    for (const Theme theme : allThemes) {
        const Tokens& c = tokens(theme);
        for (const ContrastRule& rule : contrastRules()) {
            for (const auto back : rule.backs) {
                EXPECT_GE(contrast(c.*rule.fore, c.*back), rule.least)
                    << nameOf(theme) << ": " << (c.*rule.fore).name().toStdString() << " on "
                    << (c.*back).name().toStdString();
            }
        }
        for (const QColor& line : c.series) EXPECT_GE(contrast(line, c.canvas), 3) << nameOf(theme);
    }
}

TEST(Tokens, OfDifferentMeaningAreToldApartByEveryEye) {
    for (const Theme theme : allThemes) {
        const Tokens& c = tokens(theme);
        const std::vector<QColor> meanings{c.ink, c.accent, c.fault, c.warnEdge, c.data, c.target};
        for (const Vision vision : visions) {
            for (std::size_t i = 0; i < meanings.size(); ++i) {
                for (std::size_t j = 0; j < i; ++j) {
                    EXPECT_GE(distance(meanings[i], meanings[j], vision), 10)
                        << nameOf(theme) << ' ' << meanings[i].name().toStdString() << ' '
                        << meanings[j].name().toStdString();
                }
            }
            for (std::size_t i = 0; i < 4; ++i) {
                for (std::size_t j = 0; j < i; ++j) {
                    EXPECT_GE(distance(c.series[i], c.series[j], vision), 10) << nameOf(theme);
                }
            }
        }
    }
}

TEST(ColourDistance, IsThatOfThePublishedFormula) {
    EXPECT_DOUBLE_EQ(distance(Qt::red, Qt::red, Vision::Normal), 0);
    EXPECT_NEAR(distance(Qt::black, Qt::white, Vision::Normal), 100, 0.01);
    EXPECT_NEAR(distance(Qt::red, Qt::green, Vision::Normal), 86.6, 0.1);
    EXPECT_NEAR(distance(Qt::red, Qt::blue, Vision::Normal), 52.9, 0.1);
}

TEST(Shapes, AreToldApartInAGreyPrintAtEverySize) {
    for (const Theme theme : allThemes) {
        for (const int pixels : {12, 14, 16, 32}) {
            std::vector<QImage> images;
            for (const Shape shape : allShapes) images.push_back(shapeImage(shape, pixels, theme));
            for (std::size_t i = 0; i < images.size(); ++i) {
                for (std::size_t j = 0; j < i; ++j) {
                    const auto a = word(allShapes[i]), b = word(allShapes[j]);
                    // The same mark with another word: a warning is what lies above a limit; an
                    // error is a fault.
                    if ((a == "warning" && b == "above limit") || (a == "error" && b == "Fault")) {
                        continue;
                    }
                    EXPECT_GT(greyDifference(images[i], images[j]), 0.03)
                        << nameOf(theme) << ' ' << pixels << ": " << a.toStdString() << ", "
                        << b.toStdString();
                }
            }
        }
    }
}

TEST(Shapes, HaveAWordEach) {
    for (const Shape shape : allShapes) EXPECT_FALSE(word(shape).isEmpty());
    EXPECT_EQ(word(shapeOf(State::ShuttingDown)), "ShuttingDown");
    EXPECT_EQ(word(*shapeOf(Quality::Lost)), "lost");
    EXPECT_FALSE(shapeOf(Quality::Good));
}

TEST(Texts, OfCountsHaveASingular) {
    EXPECT_EQ(QObject::tr("%n faults", nullptr, 0), "0 faults");
    EXPECT_EQ(QObject::tr("%n faults", nullptr, 1), "1 fault");
    EXPECT_EQ(QObject::tr("Set %n items", nullptr, 1), "Set 1 item");
    const QRegularExpression literal{QStringLiteral(R"re("([^"]*%n[^"]*)")re")};
    QDirIterator files{QStringLiteral(CORTEX_SOURCE_DIR "/explorer/gui"),
                       {"*.cpp"},
                       QDir::Files,
                       QDirIterator::Subdirectories};
    while (files.hasNext()) {
        QFile file{files.next()};
        ASSERT_TRUE(file.open(QIODevice::ReadOnly));
        const QString text = QString::fromUtf8(file.readAll());
        for (auto each = literal.globalMatch(text); each.hasNext();) {
            const QString written = each.next().captured(1);
            const bool known = std::ranges::any_of(plurals, [&](const auto& pair) {
                return QString::fromUtf8(pair.second).startsWith(written);
            });
            EXPECT_TRUE(known) << file.fileName().toStdString() << ": " << written.toStdString();
        }
    }
}

TEST(Glyphs, AreAllDrawn) {
    for (int i = 0; i < glyphCount; ++i) {
        QImage image{16, 16, QImage::Format_RGB32};
        image.fill(Qt::white);
        const QImage empty = image;
        QPainter painter{&image};
        paint(painter, image.rect(), static_cast<Glyph>(i), Qt::black);
        painter.end();
        EXPECT_GT(greyDifference(image, empty), 0.02) << i;
    }
}

TEST(Look, ScalesTextAndSizesTogetherAndNeverBelowNinePoints) {
    for (const double scale : {1.0, 1.25, 1.5}) {
        Look::apply(Theme::Dark, scale, QStringLiteral("Open Sans"));
        EXPECT_EQ(Look::units(7), static_cast<int>(28 * scale));
        EXPECT_GE(Look::font(TextSize::Note).pointSizeF(), 9 * scale);
    }
    Look::apply(Theme::Light, 1, QStringLiteral("Open Sans"));
}

TEST(Fonts, WithDigitsOfUnequalWidthAreNotTaken) {
    EXPECT_EQ(readableFamily(QStringLiteral("Open Sans")), "Open Sans");
    EXPECT_EQ(readableFamily(QStringLiteral("There Is No Such Font")), "Open Sans");
}

}  // namespace
}  // namespace cortex::test
