/* The stages of a frame as a page. In: pictures with their titles, texts, legends. Out: HTML that shows the pictures of
 * its folder, with a slider, a list, keys and swipes. Invariant: what is embedded cannot end the element that it stands
 * in; nothing is fetched but the pictures beside the page. */
#include "steps_page.h"

#include "page.h"

static const char *const head_lines[] = {
    "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\">",
    "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>lom steps</title><style>",
    ":root{color-scheme:dark}*{box-sizing:border-box}html,body{height:100%}",
    "body{margin:0;font:16px/1.45 system-ui,sans-serif;background:#0e1116;color:#e7ebf0;display:flex;"
    "flex-direction:column}",
    "header{display:flex;gap:8px 14px;align-items:baseline;flex-wrap:wrap;padding:8px 14px;background:#171c24}",
    "h1{font-size:17px;margin:0}header span{color:#9aa5b3;font-size:14px}header select{margin-left:auto;max-width:100%;"
    "font:inherit;font-size:14px;padding:5px;background:#222a35;color:inherit;border:1px solid #3a4554;"
    "border-radius:6px}",
    "main{flex:1 1 0;min-height:0;display:flex;flex-direction:column;overflow:auto}",
    "#stage{flex:1 1 auto;min-height:160px;display:flex;align-items:center;justify-content:center;background:#07090c;"
    "touch-action:pan-y;overflow:hidden;position:relative}",
    "#stage img{position:absolute;width:100%;height:100%;object-fit:contain;}",
    "#words{padding:10px 14px 4px;max-width:1100px;width:100%;margin:0 auto;min-height:132px}",
    "h2{font-size:20px;margin:0 0 2px}h2 small{font-weight:normal;color:#9aa5b3;font-size:14px;margin-left:8px}",
    "p{margin:2px 0 6px}code{font-size:13px;color:#9fd3ff}#legend{display:flex;flex-wrap:wrap;gap:2px 18px;"
    "font-size:14px}",
    "#legend i{display:inline-block;width:13px;height:13px;border-radius:3px;margin-right:6px;vertical-align:-2px}",
    "#scale{display:flex;align-items:center;gap:10px;font-size:14px;max-width:560px}#scale div{flex:1;height:13px;"
    "border-radius:3px}",
    "footer{display:flex;gap:10px;align-items:center;padding:8px 14px;background:#171c24}",
    "footer input{flex:1;min-width:0;height:30px;accent-color:#ffc247}button{font:inherit;min-width:48px;height:42px;"
    "border-radius:8px;border:1px solid #3a4554;background:#222a35;color:inherit}",
    "#number{min-width:64px;text-align:center;color:#9aa5b3;font-variant-numeric:tabular-nums}",
    "@media(max-width:640px){body{font-size:15px}#stage{flex:none;height:56vw}#words{min-height:0}h2{font-size:18px}}",
    "</style><header><h1>lom steps</h1><span id=\"what\"></span><select id=\"list\" aria-label=\"steps\"></select>"
    "</header>",
    "<main><div id=\"stage\"><img id=\"picture\" alt=\"\"></div><div id=\"words\"><h2 id=\"title\"></h2>",
    "<p id=\"text\"></p><div id=\"scale\"></div><div id=\"legend\"></div></div></main>",
    "<footer><button id=\"back\" aria-label=\"step back\">&#9664;</button>",
    "<input id=\"slider\" type=\"range\" min=\"1\" value=\"1\" aria-label=\"step\"><span id=\"number\"></span>",
    "<button id=\"next\" aria-label=\"next step\">&#9654;</button></footer>",
};

static const char *const script_lines[] = {
    "const data=JSON.parse(document.getElementById('data').textContent),id=name=>document.getElementById(name);",
    "const steps=data.steps,list=id('list'),slider=id('slider'),make=(tag,text)=>{const e=document.createElement(tag);",
    "if(text!==undefined)e.textContent=text;return e};let at=0,group,start=null,planned=false;",
    "steps.forEach((s,i)=>{if(!group||group.label!=s.group){group=make('optgroup');group.label=s.group;list.append("
    "group)}",
    "const o=make('option',(i+1)+' '+s.title);o.value=i+1;group.append(o)});slider.max=steps.length;",
    "id('what').textContent=data.scene+', frame '+data.frame+', '+data.width+'x'+data.height+', pass "
    "\"'+data.pass+'\"';",
    "const round=x=>+x.toPrecision(4)+'',color=c=>'rgb('+c.join(',')+')';",
    "function show(n){at=Math.max(1,Math.min(steps.length,Math.round(n)||1));const s=steps[at-1],scale=id('scale'),",
    "legend=id('legend');id('picture').src=s.file;id('picture').alt=s.title;id('title').textContent=s.title;",
    "id('title').append(make('small',s.group));id('text').textContent=s.text+' ';",
    "if(s.source)id('text').append(make('code',s.source));scale.textContent='';legend.textContent='';",
    "if(s.scale){const bar=make('div');bar.style.background='linear-gradient(90deg,'+s.scale.colors.map(color).join()+"
    "')';",
    "scale.append(make('span',round(s.scale.low)),bar,make('span',round(s.scale.high)+(s.scale.logarithmic?"
    "' (logarithmic)':'')))}",
    "for(const l of s.legend){const row=make('span'),swatch=make('i');swatch.style.background=color(l.color);"
    "row.append(swatch,l.text);legend.append(row)}",
    "if(data.plan.length&&(s.group=='Passes'||s.group=='Frame')){const "
    "rows=make('details');rows.open=planned;rows.ontoggle=()=>planned=rows.open;",
    "rows.append(make('summary','The plan of the frame'));",
    "for(const p of data.plan)rows.append(make('div',(p.runs?'\\u2022 ':'\\u2013 left out: ')+p.name+': '+p.text));",
    "legend.append(rows)}",
    "slider.value=at;list.value=at;id('number').textContent=at+' / '+steps.length;",
    "document.title='lom steps: '+at+' / '+steps.length+' '+s.title;",
    "history.replaceState(null,'','#'+at);for(const k of[at,at-2])if(steps[k])new Image().src=steps[k].file}",
    "slider.oninput=()=>show(+slider.value);list.onchange=()=>show(+list.value);",
    "id('back').onclick=()=>show(at-1);id('next').onclick=()=>show(at+1);window.onhashchange=()=>show("
    "+location.hash.slice(1));",
    "document.onkeydown=e=>{if(e.target==list)return;const to={ArrowRight:at+1,ArrowDown:at+1,PageDown:at+1,' ':at+1,",
    "ArrowLeft:at-1,ArrowUp:at-1,PageUp:at-1,Home:1,End:steps.length}[e.key];if(to){e.preventDefault();show(to)}};",
    "const stage=id('stage');stage.onpointerdown=e=>start=e.clientX;stage.onpointerup=e=>{if(start===null)return;",
    "const way=e.clientX-start;start=null;if(Math.abs(way)>40)show(at+(way<0?1:-1))};",
    "const crisp=()=>{const p=id('picture');p.style.imageRendering=p.naturalWidth<p.clientWidth?'pixelated':'auto'};",
    "id('picture').onload=crisp;window.onresize=crisp;",
    "show(+location.hash.slice(1)||1);",
};

static void write_scale(lom_json *json, const lom_stage_picture *p)
{
    lom_json_nest(json, "scale", '{');
    lom_json_number(json, "low", p->low);
    lom_json_number(json, "high", p->high);
    lom_json_bool(json, "logarithmic", p->is_logarithmic);
    lom_json_nest(json, "colors", '[');
    for (int i = 0; i < LOM_SCALE_COLORS; i++)
        lom_json_integers(json, NULL, (const int64_t[]){ p->color[i][0], p->color[i][1], p->color[i][2] }, 3);
    lom_json_unnest(json, ']');
    lom_json_unnest(json, '}');
}

void lom_write_step(lom_json *json, const char *file, const lom_stage_picture *p)
{
    lom_json_nest(json, NULL, '{');
    lom_json_text(json, "file", file);
    lom_json_text(json, "title", p->title);
    lom_json_text(json, "group", p->group);
    lom_json_text(json, "text", p->text);
    lom_json_text(json, "source", p->source);
    if (p->has_scale)
        write_scale(json, p);
    lom_json_nest(json, "legend", '[');
    for (int i = 0; i < p->legend_count; i++) {
        const lom_picture_legend *l = &p->legend[i];
        lom_json_nest(json, NULL, '{');
        lom_json_integers(json, "color", (const int64_t[]){ l->color[0], l->color[1], l->color[2] }, 3);
        lom_json_text(json, "text", l->text);
        lom_json_unnest(json, '}');
    }
    lom_json_unnest(json, ']');
    lom_json_unnest(json, '}');
}

static void write_data(FILE *out, const struct lom_steps_page *page)
{
    lom_json json = lom_json_begin(out);
    lom_json_text(&json, "scene", page->scene);
    lom_json_integer(&json, "frame", page->frame);
    lom_json_integer(&json, "width", page->pictures->width);
    lom_json_integer(&json, "height", page->pictures->height);
    lom_json_text(&json, "pass", page->pictures->pass);
    lom_json_nest(&json, "plan", '[');
    for (int i = 0; i < page->pictures->plan.count; i++) {
        const lom_step *step = &page->pictures->plan.step[i];
        lom_json_nest(&json, NULL, '{');
        lom_json_text(&json, "name", step->name);
        lom_json_bool(&json, "runs", step->runs);
        lom_json_text(&json, "text", step->text);
        lom_json_unnest(&json, '}');
    }
    lom_json_unnest(&json, ']');
    lom_json_nest(&json, "steps", '[');
    for (size_t i = 0; i < page->pictures->count; i++) {
        char file[80];
        snprintf(file, sizeof file, "%02zu-%s.png", i + 1, page->pictures->picture[i].name);
        lom_write_step(&json, file, &page->pictures->picture[i]);
    }
    lom_json_unnest(&json, ']');
    lom_json_end(&json);
}

lom_bytes lom_write_steps_page(const struct lom_steps_page *page, lom_error *error)
{
    struct lom_page json, html;
    lom_begin_page(&json);
    if (json.out != NULL)
        write_data(json.out, page);
    lom_bytes data = lom_end_page(&json, error);
    lom_begin_page(&html);
    if (html.out != NULL) {
        lom_print_lines(html.out, head_lines, sizeof head_lines / sizeof head_lines[0]);
        fputs("<script type=\"application/json\" id=\"data\">", html.out);
        lom_print_embedded(html.out, data);
        fputs("</script>\n<script>\n", html.out);
        lom_print_lines(html.out, script_lines, sizeof script_lines / sizeof script_lines[0]);
        fputs("</script></html>\n", html.out);
    }
    lom_bytes bytes = lom_end_page(&html, error);
    if (data.data == NULL) {
        lom_release(bytes.data);
        bytes = (lom_bytes){ NULL, 0 };
    }
    lom_release(data.data);
    return bytes;
}
