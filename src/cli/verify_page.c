/* Golden pictures as a page. In: what became of each, the pictures of those that fail. Out: one HTML file that needs no
 * other, with what was expected and what was drawn to slide and flick between, and the list that `lom approve -` reads.
 * Invariant: what is embedded cannot end the element that it stands in; the page approves nothing itself. */
#include "verify.h"

#include "image/data_uri.h"

static const char *const head_lines[] = {
    "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\">",
    "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>lom verify</title><style>",
    ":root{color-scheme:dark}*{box-sizing:border-box}html,body{height:100%}",
    "body{margin:0;font:15px/1.45 system-ui,sans-serif;background:#0e1116;color:#e7ebf0;display:flex;",
    "flex-direction:column}header,footer{display:flex;gap:6px 14px;align-items:center;flex-wrap:wrap;",
    "padding:8px 14px;background:#171c24}h1{font-size:17px;margin:0}header span,small{color:#9aa5b3;font-size:14px}",
    "main{flex:1 1 0;min-height:0;display:flex}#list{flex:0 0 340px;overflow:auto;margin:0;padding:0;list-style:none;",
    "background:#12161d;border-right:1px solid #262f3c}#list li{padding:7px 12px;cursor:pointer;",
    "border-left:4px solid #d8574b;border-bottom:1px solid #1d2530;overflow-wrap:anywhere}",
    "#list li.ok{border-left-color:#3d8f56;color:#8a95a3}#list li.approved{border-left-color:#4ab3ff}",
    "#list li.on{background:#26303d}#list small{display:block;font-size:13px}",
    "#view{flex:1;min-width:0;display:flex;flex-direction:column}#tools{display:flex;gap:8px;padding:8px 14px;",
    "flex-wrap:wrap;align-items:center}button{font:inherit;padding:6px 12px;border-radius:8px;",
    "border:1px solid "
    "#3a4554;background:#222a35;color:inherit;cursor:pointer}button:disabled{opacity:.4;cursor:default}",
    "button.on{background:#2b5f8a;border-color:#4ab3ff}#approve{margin-left:auto}",
    "#box{flex:1;min-height:120px;position:relative;overflow:auto;background:#07090c;touch-action:none}",
    "#stage{position:absolute;user-select:none}#stage img{position:absolute;left:0;top:0;width:100%;height:100%;",
    "pointer-events:none}#bar{position:absolute;top:0;bottom:0;width:2px;margin-left:-1px;background:#ffc247;",
    "pointer-events:none}#bar::after{content:'';position:absolute;top:50%;left:-8px;width:18px;height:18px;",
    "margin-top:-9px;border-radius:9px;background:#ffc247}#stage b{position:absolute;top:6px;padding:1px 8px;",
    "font-size:13px;background:#000a;border-radius:6px;pointer-events:none}#stage "
    "b:empty{display:none}#left{left:6px}#right{right:6px}",
    "#words{padding:8px 14px;overflow-wrap:anywhere}code,textarea{font-family:ui-monospace,monospace;font-size:13px}",
    "code{color:#9fd3ff}textarea{flex:1 1 380px;height:54px;background:#0b0e13;color:inherit;",
    "border:1px solid #3a4554;border-radius:6px}",
    "@media(max-width:760px){main{flex-direction:column}#list{flex:0 0 28%;border-right:0}}",
    "</style><header><h1>lom verify</h1><span id=\"what\"></span><span id=\"totals\"></span></header>",
    "<main><ol id=\"list\"></ol><div id=\"view\"><div id=\"tools\">",
    "<button data-mode=\"slide\">1 Slide</button><button data-mode=\"flick\">2 Flick</button>",
    "<button data-mode=\"difference\">3 Difference</button><button data-mode=\"actual\">4 Drawn</button>",
    "<button data-mode=\"expected\">5 Expected</button><button id=\"approve\">Approve (a)</button></div>",
    "<div id=\"box\"><div id=\"stage\"><img id=\"under\" alt=\"\"><img id=\"over\" alt=\"\"><div id=\"bar\"></div>",
    "<b id=\"left\"></b><b id=\"right\"></b></div></div><div id=\"words\"></div></div></main>",
    "<footer><span><span id=\"count\"></span><br><small>read by <code>lom approve -</code></small></span>",
    "<textarea id=\"approved\" readonly aria-label=\"the list of what is approved\"></textarea>",
    "<button id=\"copy\">Copy</button><button id=\"save\">Save approved.txt</button></footer>",
};

static const char *const script_lines[] = {
    "const data=JSON.parse(document.getElementById('data').textContent),id=name=>document.getElementById(name);",
    "const all=data.pictures,make=(tag,text)=>{const e=document.createElement(tag);if(text!==undefined)e.textContent=",
    "text;return e},modes=[...document.querySelectorAll('[data-mode]')];",
    "let at=0,mode='slide',part=.5,flicked=false,timer=0;",
    "const picture=(p,which)=>{const e=id(which+p.line);return e?e.textContent:''};",
    "const other=p=>p.how=='not deterministic'?'drawn again':'expected';",
    "id('what').textContent=data.manifest;id('totals').textContent=data.totals;",
    "all.forEach((p,i)=>{const li=make('li',p.text);li.append(make('small','line '+p.line+': '+p.how));",
    "if(p.how=='ok')li.className='ok';li.onclick=()=>show(i);id('list').append(li)});",
    "const can=p=>p.how=='different'||p.how=='not yet approved';",
    "function list(){const lines=all.filter(p=>p.approved).map(p=>data.manifest+':'+p.line+': '+(p.expected||'-')+' '+",
    "p.got);id('approved').value=lines.join('\\n')+(lines.length?'\\n':'');",
    "id('count').textContent=lines.length+' of '+all.filter(can).length+' approved';",
    "id('copy').disabled=id('save').disabled=!lines.length;",
    "all.forEach((p,i)=>id('list').children[i].classList.toggle('approved',!!p.approved))}",
    "function paint(){const p=all[at],drawn=picture(p,'actual'),wanted=picture(p,'expected'),two=!!wanted;",
    "const m=two?mode:'actual',under=id('under'),over=id('over');",
    "for(const b of "
    "modes){b.classList.toggle('on',b.dataset.mode==m);b.disabled=!drawn||!two&&b.dataset.mode!='actual'}",
    "under.src={slide:wanted,flick:flicked?drawn:wanted,difference:picture(p,'difference'),actual:drawn,",
    "expected:wanted}[m]||'data:,';over.hidden=id('bar').hidden=m!='slide';if(m=='slide'){over.src=drawn;",
    "over.style.clipPath='inset(0 0 0 '+100*part+'%)';id('bar').style.left=100*part+'%'}",
    "id('left').textContent=!drawn?'':m=='slide'||m=='expected'||m=='flick'&&!flicked?other(p):m=='difference'?",
    "'difference':'drawn';id('right').textContent=m=='slide'?'drawn':'';id('stage').hidden=!drawn;",
    "id('approve').disabled=!can(p);id('approve').classList.toggle('on',!!p.approved);",
    "id('approve').textContent=p.approved?'Approved (a)':'Approve (a)'}",
    "function fit(){const "
    "i=id('under'),b=id('box'),s=id('stage').style,w=i.naturalWidth,h=i.naturalHeight;if(!w)return;",
    "let k=Math.min(b.clientWidth/w,b.clientHeight/h);if(k>=1){k=Math.floor(k)}",
    "i.style.imageRendering=id('over').style.imageRendering=k>1?'pixelated':'auto';",
    "s.width=w*k+'px';s.height=h*k+'px';s.left=Math.max(0,(b.clientWidth-w*k)/2)+'px';",
    "s.top=Math.max(0,(b.clientHeight-h*k)/2)+'px'}",
    "function show(i){at=Math.max(0,Math.min(all.length-1,i));const p=all[at],w=id('words');w.textContent=p.says+'. ';",
    "if(p.how=='different'&&!picture(p,'expected'))w.append(make('small','What was expected is not at hand: name its "
    "lom '",
    "+'in the first line of the manifest, or keep a --cache.'));",
    "[...id('list').children].forEach((li,n)=>li.classList.toggle('on',n==at));",
    "id('list').children[at].scrollIntoView({block:'nearest'});document.title='lom verify: '+p.text;",
    "history.replaceState(null,'','#'+p.line);paint()}",
    "function "
    "choose(m){mode=m;flicked=false;clearInterval(timer);if(m=='flick')timer=setInterval(()=>{flicked=!flicked;",
    "paint()},600);paint()}",
    "function approve(){const p=all[at];if(!can(p))return;p.approved=!p.approved;list();paint()}",
    "for(const b of modes)b.onclick=()=>choose(b.dataset.mode);id('approve').onclick=approve;",
    "id('under').onload=fit;window.onresize=fit;",
    "const slide=e=>{const "
    "r=id('stage').getBoundingClientRect();part=Math.max(0,Math.min(1,(e.clientX-r.left)/r.width));",
    "paint()};id('box').onpointerdown=e=>{if(mode=='slide')slide(e)};",
    "id('box').onpointermove=e=>{if(e.buttons&&mode=='slide')slide(e)};",
    "document.onkeydown=e=>{if(e.ctrlKey||e.metaKey||e.altKey)return;const k=e.key,n='12345'.indexOf(k);",
    "if(n>=0&&!modes[n].disabled)choose(modes[n].dataset.mode);",
    "else if(k=='ArrowDown'||k=='j')show(at+1);else if(k=='ArrowUp'||k=='k')show(at-1);else if(k=='a')approve();",
    "else if(k==' '){if(mode!='flick')choose('flick');clearInterval(timer);flicked=!flicked;paint()}",
    "else if(k=='ArrowLeft'||k=='ArrowRight'){part=Math.max(0,Math.min(1,part+(k=='ArrowLeft'?-.02:.02)));paint()}",
    "else return;e.preventDefault()};",
    "id('copy').onclick=()=>{id('approved').select();document.execCommand('copy')};",
    "id('save').onclick=()=>{const a=make('a');a.download='approved.txt';",
    "a.href=URL.createObjectURL(new Blob([id('approved').value]));a.click()};",
    "list();const line=all.findIndex(p=>p.line==+location.hash.slice(1)),bad=all.findIndex(p=>p.how!='ok');",
    "show(line>=0?line:Math.max(0,bad));",
};

bool lom_begin_verify_page(struct lom_verify_page *page, const struct lom_manifest *manifest, lom_error *error)
{
    lom_begin_page(&page->pictures);
    lom_begin_page(&page->json);
    if (page->pictures.out == NULL || page->json.out == NULL)
        return lom_fail(error, LOM_ERROR_MEMORY, "The system gave no memory for the page.");
    page->list = lom_json_begin(page->json.out);
    lom_json_text(&page->list, "manifest", manifest->path);
    lom_json_nest(&page->list, "pictures", '[');
    return true;
}

void lom_add_to_verify_page(struct lom_verify_page *page, const struct lom_golden *golden,
                            const struct lom_outcome *outcome)
{
    static const char *const names[LOM_SHOWN_COUNT] = { "actual", "expected", "difference" };
    char text[LOM_OUTCOME_LETTERS];
    lom_describe_outcome(outcome, text);
    lom_json_nest(&page->list, NULL, '{');
    lom_json_integer(&page->list, "line", golden->number);
    lom_json_text(&page->list, "text", golden->text);
    lom_json_text(&page->list, "how", lom_verified_name(outcome->how));
    lom_json_text(&page->list, "says", text);
    if (golden->is_approved)
        lom_json_hash(&page->list, "expected", golden->expected);
    lom_json_hash(&page->list, "got", outcome->got);
    lom_json_unnest(&page->list, '}');
    for (int i = 0; i < LOM_SHOWN_COUNT; i++) {
        if (outcome->shown[i].data == NULL)
            continue;
        fprintf(page->pictures.out, "<script type=\"text/plain\" id=\"%s%d\">", names[i], golden->number);
        lom_print_data_uri(page->pictures.out, outcome->shown[i]);
        fputs("</script>\n", page->pictures.out);
    }
}

/* The totals, without the end of their line. */
static void add_totals(struct lom_verify_page *page, const int totals[LOM_VERIFIED_COUNT])
{
    struct lom_page text;
    lom_begin_page(&text);
    if (text.out != NULL)
        lom_report_totals(text.out, totals);
    lom_bytes line = lom_end_page(&text, NULL);
    if (line.size > 0)
        line.data[line.size - 1] = '\0';
    lom_json_unnest(&page->list, ']');
    lom_json_text(&page->list, "totals", (const char *)line.data);
    lom_json_end(&page->list);
    lom_release(line.data);
}

bool lom_write_verify_page(struct lom_verify_page *page, const int totals[LOM_VERIFIED_COUNT], lom_error *error)
{
    add_totals(page, totals);
    lom_bytes json = lom_end_page(&page->json, error), whole = { NULL, 0 };
    if (json.data != NULL && fflush(page->pictures.out) == 0) {
        struct lom_page html;
        lom_begin_page(&html);
        if (html.out != NULL) {
            lom_print_lines(html.out, head_lines, sizeof head_lines / sizeof head_lines[0]);
            fwrite(page->pictures.text, 1, page->pictures.size, html.out);
            fputs("<script type=\"application/json\" id=\"data\">", html.out);
            lom_print_embedded(html.out, json);
            fputs("</script>\n<script>\n", html.out);
            lom_print_lines(html.out, script_lines, sizeof script_lines / sizeof script_lines[0]);
            fputs("</script></html>\n", html.out);
        }
        whole = lom_end_page(&html, error);
    }
    bool done = whole.data != NULL && lom_write_file(page->path, whole.data, whole.size, error);
    lom_release(whole.data);
    lom_release(json.data);
    return done;
}

void lom_drop_verify_page(struct lom_verify_page *page)
{
    lom_drop_page(&page->pictures);
    lom_drop_page(&page->json);
}
