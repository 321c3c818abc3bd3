// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NoticeLine.h"

namespace qplc {

/// A line over the panels for as long as a plant lacks nodes without which it does not start: which
/// ones, why, and what to do. The LatchBanner comes first.
class MissingNotice : public NoticeLine
{
    Q_OBJECT
public:
    /// \param context  outlives the notice
    explicit MissingNotice(WindowContext *context, QWidget *parent = nullptr);

private:
    void follow();
};

}  // namespace qplc
