// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NoticeLine.h"

namespace qplc {

/// A line over the panels for as long as the window is connected to a master that listens to a
/// network without security. It cannot be closed.
class InsecureNotice : public NoticeLine
{
    Q_OBJECT
public:
    /// \param context  outlives the notice
    explicit InsecureNotice(WindowContext *context, QWidget *parent = nullptr);

private:
    void follow();
};

}  // namespace qplc
