// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NoticeLine.h"

namespace qplc {

/// A line over the panels: which person stopped a plant, how, when, and how to start again. It
/// stays until the next start, and it cannot be closed: a plant that stands still has a reason that
/// people can read.
class StopNotice : public NoticeLine
{
    Q_OBJECT
public:
    /// \param context  outlives the line
    explicit StopNotice(WindowContext *context, QWidget *parent = nullptr);

private:
    void follow();
    QString sentenceOf(const Plant &plant) const;
};

}  // namespace qplc
