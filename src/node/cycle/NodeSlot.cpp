// SPDX-License-Identifier: Apache-2.0
#include "NodeSlot.h"

namespace qplc {

namespace {

std::size_t sizeOfOutputFrame(const void *decoder, const char *header)
{
    return static_cast<const FrameDecoder *>(decoder)->frameSize(header);
}

}  // namespace

FrameVolume frameVolume(const PayloadLayout &layout, bool isSealed)
{
    const std::size_t frames = layout.partBorders(maximumPayload(isSealed)).size() - 1;
    return {frames, layout.size() + frames * (isSealed ? SealedOverhead : CyclicOverhead)};
}

void NodeSlot::prepare(const ProcessImage &image, quint64 session, const SealKeys *keys)
{
    inputRuns = image.gatherRuns(inputLayout);
    outputs = SignalGuard::frameFor(image, outputLayout);
    written.id = id;
    claims.resize(outputLayout);
    sameCycleRuns = image.gatherRuns(inputLayout, sameCycle);
    const std::uint32_t longest = maximumPayload(keys != nullptr);
    encoder = FrameEncoder(FrameKind::Inputs, {session, id, inputLayout.hash()}, inputLayout.partBorders(longest),
                           keys ? &keys->inputs : nullptr);
    decoder = FrameDecoder(FrameKind::Outputs, {session, id, outputLayout.hash()}, outputLayout.partBorders(longest),
                           keys ? &keys->outputs : nullptr);
    frames.assign(encoder.totalSize(), 0);
    inputBytes.assign(encoder.partCount() == 1 && !keys ? 0 : inputLayout.size(), 0);
    inputs = inputBytes.empty() ? frames.data() + CyclicHeaderSize : inputBytes.data();
}

FrameCutter NodeSlot::outputCutter() const
{
    return {CyclicHeaderSize, &sizeOfOutputFrame, &decoder};
}

}  // namespace qplc
