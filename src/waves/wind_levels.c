/* The Beaufort scale: names for winds and what they do to the sea. Speeds are 0.836 B^(3/2) m/s, the scale's definition
 * (World Meteorological Organization: Guide to meteorological instruments, CIMO 8, part I, ch. 5). */
#include <lom/sea.h>

#include <string.h>

static const lom_wind_level levels[] = {
    { "calm", 0, 0, "like a mirror" },
    { "light-air", 1, 0.836, "ripples like scales, without crests" },
    { "light-breeze", 2, 2.365, "small wavelets with glassy crests that do not break" },
    { "gentle-breeze", 3, 4.344, "large wavelets, the first crests break" },
    { "moderate-breeze", 4, 6.688, "small waves, fairly frequent white horses" },
    { "fresh-breeze", 5, 9.347, "moderate, longer waves, many white horses" },
    { "strong-breeze", 6, 12.287, "large waves, white foam crests everywhere, some spray" },
    { "near-gale", 7, 15.483, "the sea heaps up, foam is blown in streaks along the wind" },
    { "gale", 8, 18.916, "high waves of greater length, crests break into spindrift" },
    { "strong-gale", 9, 22.572, "high waves, dense streaks of foam, crests topple over" },
    { "storm", 10, 26.437, "very high waves with overhanging crests, the sea looks white" },
    { "violent-storm", 11, 30.5, "exceptionally high waves, covered with patches of foam" },
    { "hurricane", 12, 34.752, "air filled with foam and spray, the sea white with driving spray" },
};
enum { LEVEL_COUNT = sizeof levels / sizeof levels[0] };

int lom_wind_level_count(void)
{
    return LEVEL_COUNT;
}

const lom_wind_level *lom_wind_level_at(int index)
{
    return index >= 0 && index < LEVEL_COUNT ? &levels[index] : NULL;
}

const lom_wind_level *lom_find_wind_level(const char *name, lom_error *error)
{
    const char *names[LEVEL_COUNT];
    for (int i = 0; i < LEVEL_COUNT; i++) {
        names[i] = levels[i].name;
        if (strcmp(name, names[i]) == 0)
            return &levels[i];
    }
    const char *near = lom_nearest_name(name, strlen(name), names, LEVEL_COUNT);
    if (near != NULL)
        lom_fail(error, LOM_ERROR_INPUT, "There is no wind level \"%.60s\" (did you mean \"%s\"?).", name, near);
    else
        lom_fail(error, LOM_ERROR_INPUT, "There is no wind level \"%.60s\"; they go from \"calm\" to \"hurricane\".",
                 name);
    return NULL;
}
