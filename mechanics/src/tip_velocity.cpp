// SPDX-License-Identifier: Apache-2.0
#include "cortex/mechanics/tip_velocity.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace cortex::mechanics {

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, SerialChain::maxJoints>;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using Counted = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;

constexpr double near = 0.05, mostDamping = 0.05;

Rows countedRows(const SerialChain::Jacobian& jacobian, const Directions& directions) {
    Rows rows(count(directions), jacobian.cols());
    Eigen::Index next = 0;
    for (Eigen::Index i = 0; i < 6; ++i) {
        if (directions[static_cast<std::size_t>(i)]) rows.row(next++) = jacobian.row(i);
    }
    return rows;
}

Counted countedOf(const Twist& tip, const Directions& directions) {
    Counted counted(count(directions));
    Eigen::Index next = 0;
    for (Eigen::Index i = 0; i < 6; ++i) {
        if (directions[static_cast<std::size_t>(i)]) counted[next++] = tip[i];
    }
    return counted;
}

// Of JJ': its vectors are those of J on the left, its values the squares.
Eigen::SelfAdjointEigenSolver<Square> decomposed(const Rows& rows) {
    const Square normal = rows.lazyProduct(rows.transpose());
    return Eigen::SelfAdjointEigenSolver<Square>{normal};
}

}  // namespace

int count(const Directions& directions) {
    return static_cast<int>(std::ranges::count(directions, true));
}

TipVelocity jointVelocities(const SerialChain::Jacobian& jacobian, const Twist& tip,
                            const Directions& directions) {
    const Rows rows = countedRows(jacobian, directions);
    const auto parts = decomposed(rows);
    const Counted squares = parts.eigenvalues().cwiseMax(0.0);
    TipVelocity result;
    result.smallest = std::sqrt(squares.minCoeff());
    result.manipulability = std::sqrt(squares.prod());
    result.damped = result.smallest < near;
    const double share = result.smallest / near;
    const double damping = result.damped ? (1 - share * share) * mostDamping * mostDamping : 0.0;
    const Counted along = parts.eigenvectors().transpose().lazyProduct(countedOf(tip, directions));
    const Counted weights =
        parts.eigenvectors().lazyProduct(along.cwiseQuotient((squares.array() + damping).matrix()));
    result.joints = rows.transpose().lazyProduct(weights);
    return result;
}

SerialChain::JointVector selfMotion(const SerialChain::Jacobian& jacobian,
                                    const Directions& directions,
                                    const SerialChain::JointVector& before) {
    const Eigen::Index joints = jacobian.cols();
    SerialChain::JointVector motion = SerialChain::JointVector::Zero(joints);
    if (joints <= count(directions)) return motion;
    const Rows rows = countedRows(jacobian, directions);
    const auto parts = decomposed(rows);
    constexpr double least = 1e-9;  // of a square: below, the direction is lost
    double longest = 0;
    // The longest column of I − J⁺J.
    for (Eigen::Index i = 0; i < joints; ++i) {
        Counted along = parts.eigenvectors().transpose().lazyProduct(rows.col(i));
        for (Eigen::Index k = 0; k < along.size(); ++k) {
            const double square = parts.eigenvalues()[k];
            along[k] = square > least ? along[k] / square : 0.0;
        }
        const Counted weights = parts.eigenvectors().lazyProduct(along);
        SerialChain::JointVector column = -rows.transpose().lazyProduct(weights);
        column[i] += 1;
        if (column.norm() <= longest) continue;
        longest = column.norm();
        motion = column;
    }
    motion /= longest;
    if (motion.dot(before) < 0) motion = -motion;
    return motion;
}

}  // namespace cortex::mechanics
