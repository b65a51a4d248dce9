// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QColor>

namespace cortex::test {

enum class Vision { Normal, Protanopia, Deuteranopia, Tritanopia };

// How far apart two colours are for such eyes: CIEDE2000 of the colours as simulated by Machado,
// Oliveira and Fernandes (2009), severity 1, in linear RGB.
double distance(const QColor& one, const QColor& other, Vision vision);

}  // namespace cortex::test
