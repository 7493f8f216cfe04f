/// Render settings: types hosts send, and no restart for what does not change.
#include <gtest/gtest.h>

#include "testenv/unit/delegate/test_host.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

const TfToken samples("convergedSamplesPerPixel"), dome("domeLightCameraVisibility");

TEST(Settings, takeEveryNumberTypeAndText) {
    HdHiprRenderDelegate delegate;
    const std::pair<VtValue, int> values[] = {{VtValue(7), 7},
                                              {VtValue(8L), 8},
                                              {VtValue(9u), 9},
                                              {VtValue(10.0), 10},
                                              {VtValue(11.f), 11},
                                              {VtValue(std::string("12")), 12},
                                              {VtValue(TfToken("13")), 13}};
    for (auto const& [value, expected] : values) {
        delegate.SetRenderSetting(samples, value);
        ASSERT_TRUE(delegate.GetRenderSetting(samples).IsHolding<int>());
        EXPECT_EQ(delegate.GetRenderSetting(samples).UncheckedGet<int>(), expected);
    }
    delegate.SetRenderSetting(dome, VtValue(0));
    EXPECT_FALSE(delegate.GetRenderSetting<bool>(dome, true));
    delegate.SetRenderSetting(dome, VtValue(1L));
    EXPECT_TRUE(delegate.GetRenderSetting<bool>(dome, false));
}

TEST(Settings, thatDoNotChangeDoNotCount) {
    HdHiprRenderDelegate delegate;
    delegate.SetRenderSetting(samples, VtValue(7));
    const unsigned version = delegate.GetRenderSettingsVersion();
    delegate.SetRenderSetting(samples, VtValue(7));
    delegate.SetRenderSetting(samples, VtValue(7.0));
    delegate.SetRenderSetting(TfToken("someOtherRenderer:setting"), VtValue(1));
    delegate.SetRenderSetting(samples, VtValue(-5));           // out of range
    delegate.SetRenderSetting(samples, VtValue(GfVec3f(1.f))); // no number
    EXPECT_EQ(delegate.GetRenderSettingsVersion(), version);
    EXPECT_EQ(delegate.GetRenderSetting<int>(samples, 0), 7);
    delegate.SetRenderSetting(samples, VtValue(8));
    EXPECT_NE(delegate.GetRenderSettingsVersion(), version);
}

TEST(Settings, areDescribedWithTypedDefaults) {
    HdHiprRenderDelegate delegate;
    const HdRenderSettingDescriptorList list = delegate.GetRenderSettingDescriptors();
    ASSERT_FALSE(list.empty());
    for (HdRenderSettingDescriptor const& setting : list) {
        VtValue const& value = setting.defaultValue;
        EXPECT_FALSE(setting.name.empty());
        EXPECT_TRUE(value.IsHolding<bool>() || value.IsHolding<int>() || value.IsHolding<float>() ||
                    value.IsHolding<std::string>())
            << setting.key;
        EXPECT_EQ(delegate.GetRenderSetting(setting.key), value) << setting.key;
    }
}

TEST(Settings, fromTheSettingsMapHold) {
    HdRenderSettingsMap map;
    map[samples] = VtValue(3);
    HdHiprRenderDelegate delegate(map);
    EXPECT_EQ(delegate.GetRenderSetting<int>(samples, 0), 3);
}

} // namespace
